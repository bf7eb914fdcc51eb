//! How errors of the core become errors of JavaScript.

use js_sys::Reflect;
use wasm_bindgen::prelude::*;

use crate::error::Error;

/// A number as JavaScript writes it.
pub(super) fn number(n: f64) -> String {
    js_sys::Object::from(JsValue::from_f64(n)).to_string().into()
}

/// The only conversion of errors: `name` is the code for machines, `message` the text for people.
impl From<Error> for JsValue {
    fn from(error: Error) -> JsValue {
        let js = js_sys::Error::new(&error.message(number));
        js.set_name(error.code());
        let [value, min, max] = error.numbers();
        for (key, number) in [("value", value), ("min", min), ("max", max)] {
            // Setting a property of a fresh Error cannot fail.
            let _ = Reflect::set(&js, &key.into(), &number.into());
        }
        let _ = Reflect::set(&js, &"key".into(), &error.key().into());
        let layer = error.layer().map_or(JsValue::UNDEFINED, |layer| (layer as u32).into());
        let _ = Reflect::set(&js, &"layer".into(), &layer);
        js.into()
    }
}
