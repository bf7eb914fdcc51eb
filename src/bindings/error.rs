//! How errors of the core become errors of JavaScript.

use js_sys::Reflect;
use wasm_bindgen::prelude::*;

use crate::error::Error;

/// A number as JavaScript writes it.
pub(super) fn number(n: f64) -> String {
    js_sys::Object::from(JsValue::from_f64(n)).to_string().into()
}

/// The only conversion of errors: `name` is the code for machines, `message` the text for people.
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
        // Setting a property of a fresh Error cannot fail.
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
