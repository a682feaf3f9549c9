//! Declarative render-graph nodes for filterable shadows.
