//! rock-field (crate documentation follows with the modules).
#![allow(missing_docs, reason = "skeleton")]
