//! Means.
