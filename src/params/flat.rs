//! The parameters as a flat list of numbers: the one form that crosses the wasm boundary.
//!
//! `[field rows in table order…, number of layers, then per layer: id, layer rows in table order…]`

use super::{Kind, Layer, MAX_LAYERS, Notation, PARAMS, ParamSpec, Params, Scope};
use crate::error::Error;

impl Params {
    /// All values in table order; see [`Params::from_flat`].
    pub fn to_flat(&self) -> Vec<f64> {
        let mut flat = Vec::new();
        flat.extend(PARAMS.iter().filter_map(|spec| match spec.scope {
            Scope::Field(get, _) => Some(get(self)),
            Scope::Layer(..) => None,
        }));
        flat.push(self.layers.len() as f64);
        for layer in &self.layers {
            flat.push(f64::from(layer.id));
            flat.extend(PARAMS.iter().filter_map(|spec| match spec.scope {
                Scope::Layer(get, _) => Some(get(layer)),
                Scope::Field(..) => None,
            }));
        }
        flat
    }

    /// Reads `[field rows…, number of layers, per layer: id, layer rows…]`, rows in the order of [`PARAMS`].
    ///
    /// A choice is the index of its word; an optional number is NaN for "none".
    ///
    /// # Errors
    /// The first value out of range, with its key, value and bounds; a wrong length; a repeated layer id.
    pub fn from_flat(flat: &[f64]) -> Result<Params, Error> {
        let field_rows = PARAMS.iter().filter(|spec| matches!(spec.scope, Scope::Field(..))).count();
        let layer_rows = PARAMS.len() - field_rows;
        let malformed = |expected| Error::MalformedRequest { value: flat.len(), expected };
        let layer_count = *flat.get(field_rows).ok_or(malformed(field_rows + 1))?;
        if !(layer_count >= 0.0 && layer_count <= MAX_LAYERS as f64) {
            return Err(Error::TooManyLayers { value: layer_count as usize, max: MAX_LAYERS });
        }
        let layer_count = layer_count as usize;
        let expected = field_rows + 1 + layer_count * (layer_rows + 1);
        if flat.len() != expected {
            return Err(malformed(expected));
        }

        let mut params = Params { layers: Vec::with_capacity(layer_count), ..Params::EMPTY };
        let field_specs = PARAMS.iter().filter(|spec| matches!(spec.scope, Scope::Field(..)));
        for (spec, &value) in field_specs.zip(flat) {
            if let Scope::Field(_, set) = spec.scope {
                set(&mut params, check(spec, Notation::Px, None, value)?);
            }
        }
        let layers = flat.get(field_rows + 1..).unwrap_or_default();
        for (index, row) in layers.chunks_exact(layer_rows + 1).enumerate() {
            let id = check_id(row.first().copied().unwrap_or(f64::NAN), index)?;
            if params.layers.iter().any(|other| other.id == id) {
                return Err(Error::DuplicateLayerId { value: id });
            }
            let mut layer = Layer::with_defaults(id, params.notation);
            let layer_specs = PARAMS.iter().filter(|spec| matches!(spec.scope, Scope::Layer(..)));
            for (spec, &value) in layer_specs.zip(row.iter().skip(1)) {
                if let Scope::Layer(_, set) = spec.scope {
                    set(&mut layer, check(spec, params.notation, Some(index), value)?);
                }
            }
            params.layers.push(layer);
        }
        Ok(params)
    }
}

fn check_id(value: f64, index: usize) -> Result<u32, Error> {
    if value >= 0.0 && value <= f64::from(u32::MAX) && value == value.trunc() {
        Ok(value as u32)
    } else {
        Err(Error::OutOfRange { key: "id", layer: Some(index), value, min: 0.0, max: f64::from(u32::MAX) })
    }
}

fn check(spec: &ParamSpec, notation: Notation, layer: Option<usize>, value: f64) -> Result<f64, Error> {
    let range = spec.range(notation);
    if spec.kind == Kind::OptionalInteger && value.is_nan() {
        return Ok(value);
    }
    // Written so that NaN fails too.
    if !(value >= range.min && value <= range.max) {
        return Err(Error::OutOfRange { key: spec.key, layer, value, min: range.min, max: range.max });
    }
    if !matches!(spec.kind, Kind::Real) && value != value.trunc() {
        return Err(Error::NotAnInteger { key: spec.key, layer, value });
    }
    Ok(value)
}
