//! What a run is given beside its parameters.

/// A value that is used from the next run on, and its version.
#[derive(Debug, Default)]
pub(super) struct Given<T> {
    pub(super) value: T,
    /// Changes when another value is used.
    pub(super) version: u64,
    /// The value to be used from the next start on.
    next: Option<T>,
}

impl<T> Given<T> {
    pub(super) fn set(&mut self, value: T) {
        self.next = Some(value);
    }

    /// What the next run will use.
    pub(super) fn wanted(&self) -> &T {
        self.next.as_ref().unwrap_or(&self.value)
    }

    /// Uses what was set, under a new version.
    pub(super) fn take_over(&mut self, versions: &mut u64) {
        if let Some(value) = self.next.take() {
            *versions += 1;
            (self.value, self.version) = (value, *versions);
        }
    }

    /// The sum over the values that are held.
    pub(super) fn sum(&self, of: impl Fn(&T) -> usize) -> usize {
        of(&self.value) + self.next.as_ref().map_or(0, of)
    }
}
