//! The input `ranges` that nodes share: moment depths of a map may be fitted to what its casters take of the host's range.

use moment_shadows::TextureFormat;

use super::{Specialization, wrong_format};
use crate::{
    Binding, BindingResource, Connected, GraphError, GraphErrorKind, Rule, Slot, TextureDesc,
    TextureRule, bind,
};

const SLOT: &str = "ranges";

fn slot() -> Slot {
    let rule = TextureRule::new(TextureFormat::Rgba32Float).layers(Rule::Any);
    let description =
        "What casters take of the host's range of moment depth: the output of a node 'fit_range'.";
    Slot::input(SLOT, description, rule).optional()
}

fn connected<'a>(upstream: &Connected<'a>) -> Result<Option<&'a TextureDesc>, GraphError> {
    match upstream.get(SLOT) {
        Some(_) => upstream.texture(SLOT).map(Some),
        None => Ok(None),
    }
}

/// The specialization, with the module that gives the range, the slot, and its binding where it is connected.
type WithRange = (Specialization, Slot, Option<Binding>);

fn with(
    specialization: Specialization,
    ranges: Option<&TextureDesc>,
    (name, none, fitted): (&str, &'static str, &'static str),
    bound: fn(&str) -> BindingResource,
) -> WithRange {
    let text = if ranges.is_some() { fitted } else { none };
    let specialization = specialization
        .constant("FITTED", ranges.is_some())
        .module(name, text);
    let binding = ranges.map(|_| Binding::new("ranges_map", bound(SLOT)));
    (specialization, slot(), binding)
}

/// For a node that makes a map, layer by layer: the module `range_of_region`.
pub(in crate::nodes) fn of_maker(
    specialization: Specialization,
    upstream: &Connected<'_>,
    depth: &TextureDesc,
) -> Result<WithRange, GraphError> {
    let ranges = connected(upstream)?;
    if let Some(ranges) = ranges {
        if ranges.range.is_none() {
            let message = "what is connected holds no ranges; connect the output 'ranges' of a node 'fit_range'";
            return Err(wrong_format(message).at_slot(SLOT));
        }
        let (has, needs) = (
            [ranges.size[0], ranges.layers],
            [depth.regions, depth.layers],
        );
        if has != needs {
            return Err(wrong_format(format!(
                "there are ranges of {} regions in {} layers, but the depth map has {} in {}; connect the node 'fit_range' to the \
                 same depth map",
                has[0], has[1], needs[0], needs[1]
            ))
            .at_slot(SLOT));
        }
    }
    let modules = (
        "range_of_region",
        include_str!("range_of_region_none.wgsl"),
        include_str!("range_of_region_fitted.wgsl"),
    );
    Ok(with(specialization, ranges, modules, bind::layer))
}

/// For a node that looks up a map: the module `range_of_view`. Refused, if the map's depths are fitted to another range than what
/// is connected.
pub(in crate::nodes) fn of_reader(
    specialization: Specialization,
    upstream: &Connected<'_>,
    map: &TextureDesc,
) -> Result<WithRange, GraphError> {
    let ranges = connected(upstream)?;
    let wrong = match (&map.range, ranges) {
        (None, None) => None,
        (Some(range), None) => Some((
            GraphErrorKind::MissingInput,
            format!("the map's depths are fitted to '{range}'; connect that to this input, too"),
        )),
        (None, Some(_)) => Some((
            GraphErrorKind::Format,
            "the map's depths are not fitted; connect the ranges to the node 'resolve' that makes the map, too, or to neither"
                .to_owned(),
        )),
        (Some(range), Some(ranges)) => match &ranges.range {
            Some(other) if other == range => None,
            other => Some((
                GraphErrorKind::Format,
                format!(
                    "the map's depths are fitted to '{range}', but {} is connected; connect the former",
                    other.as_ref().map_or("something else".to_owned(), |it| format!("'{it}'"))
                ),
            )),
        },
    };
    if let Some((kind, message)) = wrong {
        return Err(GraphError::new(kind, message).at_slot(SLOT));
    }
    Ok(with(specialization, ranges, OF_VIEW, bind::layers))
}

const OF_VIEW: (&str, &str, &str) = (
    "range_of_view",
    include_str!("range_of_view_none.wgsl"),
    include_str!("range_of_view_fitted.wgsl"),
);

/// For a node that looks up the plain depth map: no range is fitted for that.
pub(in crate::nodes) fn none(specialization: Specialization) -> Specialization {
    let (name, none, _) = OF_VIEW;
    specialization.constant("FITTED", false).module(name, none)
}

/// The refusal of maps whose depths are fitted, by a node that does `what` with them.
pub(in crate::nodes) fn refuse(map: &TextureDesc, what: &str) -> Result<(), GraphError> {
    let Some(range) = &map.range else {
        return Ok(());
    };
    let message = format!(
        "the map's depths are fitted to '{range}'; this node {what} in the host's range: connect a map of a node 'resolve' without \
         the input 'ranges'"
    );
    Err(wrong_format(message).at_slot("map"))
}
