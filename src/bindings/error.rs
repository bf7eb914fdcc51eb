//! Converts errors of the generators to JavaScript errors.

use js_sys::Reflect;
use wasm_bindgen::prelude::*;

use crate::error::Error;

/// Converts a number to text in the way of JavaScript.
pub(super) fn number(n: f64) -> String {
    js_sys::Object::from(JsValue::from_f64(n)).to_string().into()
}

/// Makes a JavaScript error: `name` is the code for programs, `message` the text for people, and `key`, `layer`,
/// `value`, `min` and `max` are properties. All errors of the generators are converted here.
pub(super) fn coded(
    code: &str,
    message: &str,
    key: &str,
    layer: Option<usize>,
    [value, min, max]: [f64; 3],
) -> JsValue {
    let js = js_sys::Error::new(message);
    js.set_name(code);
    for (key, number) in [("value", value), ("min", min), ("max", max)] {
        // Setting a property of a new Error cannot fail.
        let _ = Reflect::set(&js, &key.into(), &number.into());
    }
    let _ = Reflect::set(&js, &"key".into(), &key.into());
    let layer = layer.map_or(JsValue::UNDEFINED, |layer| (layer as u32).into());
    let _ = Reflect::set(&js, &"layer".into(), &layer);
    js.into()
}

impl From<Error> for JsValue {
    fn from(error: Error) -> JsValue {
        coded(error.code(), &error.message(&number), error.key(), error.layer(), error.numbers())
    }
}
