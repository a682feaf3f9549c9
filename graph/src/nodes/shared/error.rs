//! What is wrong with a node's properties, or with what it is connected to.

use core::fmt::Display;

use crate::{GraphError, GraphErrorKind};

pub(in crate::nodes) fn wrong_property(message: impl Display) -> GraphError {
    GraphError::new(GraphErrorKind::Property, message.to_string())
}

pub(in crate::nodes) fn wrong_format(message: impl Display) -> GraphError {
    GraphError::new(GraphErrorKind::Format, message.to_string())
}

pub(in crate::nodes) fn wrong_size(message: impl Display) -> GraphError {
    GraphError::new(GraphErrorKind::Size, message.to_string())
}
