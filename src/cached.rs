//! The result of a stage, and what it was made from.

/// The result of a stage and the key of the inputs it was made from.
#[derive(Debug)]
pub(crate) struct Cached<K, V> {
    pub(crate) key: Option<K>,
    /// Changes exactly when the value does. Later stages use it as part of their key.
    pub(crate) version: u64,
    pub(crate) value: V,
}

impl<K, V: Default> Default for Cached<K, V> {
    fn default() -> Self {
        Cached { key: None, version: 0, value: V::default() }
    }
}

impl<K: PartialEq, V: Default> Cached<K, V> {
    pub(crate) fn is_current(&self, key: &K) -> bool {
        self.key.as_ref() == Some(key)
    }

    /// Keeps a new value, under its key.
    pub(crate) fn store(&mut self, key: K, value: V) {
        (self.key, self.value) = (Some(key), value);
        self.version += 1;
    }

    /// Frees the value. The version stays, so that a later value does not get the version of an earlier one.
    pub(crate) fn clear(&mut self) {
        (self.key, self.value) = (None, V::default());
    }
}
