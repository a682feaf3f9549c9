//! What the driver says about a compiled stage.

use std::collections::BTreeMap;

use ash::vk;

use super::{NullDevice, refused};
use crate::error::LabError;
use crate::isa::driver::incomplete;

/// Statistics by the driver's names, and the disassembly.
#[derive(Clone, Debug)]
pub(in crate::isa) struct Executable {
    pub(in crate::isa) statistics: BTreeMap<String, u64>,
    pub(in crate::isa) isa: String,
}

/// The name of the representation that is the disassembly.
const DISASSEMBLY: &str = "Assembly";

/// Asks for one stage of a pipeline that captures statistics and representations.
pub(super) fn of_pipeline(
    device: &NullDevice,
    pipeline: vk::Pipeline,
    stage: vk::ShaderStageFlags,
) -> Result<Executable, LabError> {
    let info = vk::PipelineInfoKHR::default().pipeline(pipeline);
    // SAFETY: the pipeline is alive, and its device has the extension.
    let all = unsafe { device.executables.get_pipeline_executable_properties(&info) }
        .map_err(refused("the stages of a pipeline"))?;
    let index = all
        .iter()
        .position(|executable| executable.stages.contains(stage))
        .ok_or_else(|| incomplete("the stage that was asked for"))?;
    let info = vk::PipelineExecutableInfoKHR::default()
        .pipeline(pipeline)
        .executable_index(index as u32);
    Ok(Executable {
        statistics: statistics(device, &info)?,
        isa: disassembly(device, &info)?,
    })
}

fn statistics(
    device: &NullDevice,
    info: &vk::PipelineExecutableInfoKHR<'_>,
) -> Result<BTreeMap<String, u64>, LabError> {
    // SAFETY: the pipeline is alive and was made with `CAPTURE_STATISTICS`.
    let all = unsafe { device.executables.get_pipeline_executable_statistics(info) }
        .map_err(refused("the statistics of a pipeline"))?;
    let mut statistics = BTreeMap::new();
    for statistic in &all {
        if statistic.format != vk::PipelineExecutableStatisticFormatKHR::UINT64 {
            continue;
        }
        let Ok(name) = statistic.name_as_c_str() else {
            continue;
        };
        // SAFETY: the format says that the value is this one.
        let value = unsafe { statistic.value.u64 };
        statistics.insert(name.to_string_lossy().into_owned(), value);
    }
    Ok(statistics)
}

fn disassembly(
    device: &NullDevice,
    info: &vk::PipelineExecutableInfoKHR<'_>,
) -> Result<String, LabError> {
    let failed = refused("the text of a pipeline");
    // SAFETY: the pipeline is alive and was made with `CAPTURE_INTERNAL_REPRESENTATIONS`.
    let mut all = unsafe {
        device
            .executables
            .get_pipeline_executable_internal_representations(info)
    }
    .map_err(&failed)?;
    // The first call told the sizes; the second one fills the memory.
    let mut texts: Vec<Vec<u8>> = all.iter().map(|one| vec![0; one.data_size]).collect();
    for (one, text) in all.iter_mut().zip(&mut texts) {
        one.p_data = text.as_mut_ptr().cast();
    }
    let mut count = all.len() as u32;
    let call = device
        .executables
        .fp()
        .get_pipeline_executable_internal_representations_khr;
    // SAFETY: `all` has `count` elements, and each points to `data_size` bytes of `texts`, which outlive the call.
    unsafe { call(device.device.handle(), info, &mut count, all.as_mut_ptr()) }
        .result()
        .map_err(&failed)?;
    let index = all
        .iter()
        .position(|one| {
            one.name_as_c_str()
                .is_ok_and(|name| name.to_string_lossy() == DISASSEMBLY)
        })
        .ok_or_else(|| incomplete("the disassembly"))?;
    let text = String::from_utf8_lossy(&texts[index]);
    Ok(text.trim_end_matches('\0').to_owned())
}
