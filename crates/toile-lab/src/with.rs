//! Values that are another one but for some fields.

/// A value with some of its fields set, where it is needed as an expression.
pub fn with<T>(mut value: T, set: impl FnOnce(&mut T)) -> T {
    set(&mut value);
    value
}
