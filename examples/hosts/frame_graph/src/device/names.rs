//! WebGPU's names, as the plan has them, to the values of this wgpu.

use moment_shadows_graph::Usage;
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::error::HostError;

/// The value with this name.
pub fn by_name<T: DeserializeOwned>(named: impl Serialize) -> Result<T, HostError> {
    Ok(serde_json::from_value(serde_json::to_value(named)?)?)
}

/// The flags with these names.
pub fn usage<T: DeserializeOwned>(named: &[Usage]) -> Result<T, HostError> {
    let names = named.iter().map(by_name::<String>);
    by_name(names.collect::<Result<Vec<_>, _>>()?.join(" | "))
}
