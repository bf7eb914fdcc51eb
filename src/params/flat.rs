//! The parameters as a flat list of numbers, which is the only form in which they cross the wasm boundary.
//!
//! `[field rows in table order…, number of items, then per item: its id if it has one, item rows in table order…]`

use super::spec::{Kind, Notation, ParamSpec, Range, Scope};
use crate::error::Error;

/// Parameters that a table describes: values of the whole, and values of each item of a list.
pub(super) trait Flat: Sized + 'static {
    type Item: 'static;
    type Stage: 'static;
    const ROWS: &'static [ParamSpec<Self, Self::Item, Self::Stage>];
    /// How many numbers precede an item's rows: 1 if it has an id, 0 otherwise.
    const HEAD: usize;

    /// Parameters with all values zeroed, which the table's rows then fill in, with room for this many items.
    ///
    /// # Errors
    /// Returns an error if there cannot be this many items.
    fn empty(items: f64) -> Result<Self, Error>;

    /// The units of the items' lengths.
    fn notation(&self) -> Notation;

    fn items(&self) -> &[Self::Item];

    /// The number that precedes an item's rows, if there is one.
    fn head(item: &Self::Item) -> Option<f64>;

    /// Appends an item and returns it, so that its values can be set.
    ///
    /// # Errors
    /// Returns an error if `head` is not valid.
    fn append(&mut self, head: &[f64]) -> Result<&mut Self::Item, Error>;
}

pub(super) fn to_flat<T: Flat>(params: &T) -> Vec<f64> {
    let mut flat = Vec::new();
    flat.extend(T::ROWS.iter().filter_map(|spec| match spec.scope {
        Scope::Field(get, _) => Some(get(params)),
        Scope::Item(..) => None,
    }));
    flat.push(params.items().len() as f64);
    for item in params.items() {
        flat.extend(T::head(item));
        flat.extend(T::ROWS.iter().filter_map(|spec| match spec.scope {
            Scope::Item(get, _) => Some(get(item)),
            Scope::Field(..) => None,
        }));
    }
    flat
}

pub(super) fn from_flat<T: Flat>(flat: &[f64]) -> Result<T, Error> {
    let field_rows = T::ROWS.iter().filter(|spec| matches!(spec.scope, Scope::Field(..))).count();
    let stride = T::ROWS.len() - field_rows + T::HEAD;
    let malformed = |expected| Error::MalformedRequest { value: flat.len(), expected };
    let items = *flat.get(field_rows).ok_or(malformed(field_rows + 1))?;
    let mut params = T::empty(items)?;
    let expected = field_rows + 1 + items as usize * stride;
    if flat.len() != expected {
        return Err(malformed(expected));
    }
    let specs = T::ROWS.iter().filter(|spec| matches!(spec.scope, Scope::Field(..)));
    for (spec, &value) in specs.zip(flat) {
        if let Scope::Field(_, set) = spec.scope {
            set(&mut params, check(spec.key, spec.kind, spec.range, None, value)?);
        }
    }
    let notation = params.notation();
    let items = flat.get(field_rows + 1..).unwrap_or_default();
    for (index, numbers) in items.chunks_exact(stride).enumerate() {
        let (head, values) = numbers.split_at_checked(T::HEAD).unwrap_or_default();
        let item = params.append(head)?;
        let specs = T::ROWS.iter().filter(|spec| matches!(spec.scope, Scope::Item(..)));
        for (spec, &value) in specs.zip(values) {
            if let Scope::Item(_, set) = spec.scope {
                set(item, check(spec.key, spec.kind, spec.range(notation), Some(index), value)?);
            }
        }
    }
    Ok(params)
}

fn check(key: &'static str, kind: Kind, range: Range, layer: Option<usize>, value: f64) -> Result<f64, Error> {
    if kind.is_optional() && value.is_nan() {
        return Ok(value);
    }
    // Written so that NaN is refused too.
    if !(value >= range.min && value <= range.max) {
        return Err(Error::OutOfRange { key, layer, value, min: range.min, max: range.max });
    }
    if !matches!(kind, Kind::Real | Kind::OptionalReal) && value != value.trunc() {
        return Err(Error::NotAnInteger { key, layer, value });
    }
    Ok(value)
}
