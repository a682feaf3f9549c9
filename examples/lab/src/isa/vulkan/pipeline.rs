//! One pipeline per shader, made only to be asked. The driver frees everything when the process ends, which it does then.

use ash::vk;

use super::{Executable, NullDevice, executable, refused};
use crate::error::LabError;
use crate::isa::spirv::{Bound, SpirvModule};
use moment_shadows::TextureFormat;

/// Pipelines, or those that could be made and what went wrong.
type Made = Result<Vec<vk::Pipeline>, (Vec<vk::Pipeline>, vk::Result)>;

/// So that the driver keeps the text of what it makes.
const FLAGS: vk::PipelineCreateFlags = vk::PipelineCreateFlags::from_raw(
    vk::PipelineCreateFlags::CAPTURE_STATISTICS_KHR.as_raw()
        | vk::PipelineCreateFlags::CAPTURE_INTERNAL_REPRESENTATIONS_KHR.as_raw(),
);

impl NullDevice {
    /// Compiles a compute shader, or a fragment shader with the vertex shader and the targets that it is drawn with, and gives
    /// what the driver says about it.
    pub(in crate::isa) fn compile(
        &self,
        module: &SpirvModule,
        drawn: Option<(&SpirvModule, TextureFormat, usize)>,
    ) -> Result<Executable, LabError> {
        let layout = self.layout(&module.bindings)?;
        let (pipelines, asked) = if let Some((vertex, target, targets)) = drawn {
            let asked = vk::ShaderStageFlags::FRAGMENT;
            let stages = [
                self.stage(vertex, vk::ShaderStageFlags::VERTEX)?,
                self.stage(module, asked)?,
            ];
            (self.fragment(layout, &stages, (target, targets)), asked)
        } else {
            let asked = vk::ShaderStageFlags::COMPUTE;
            (self.compute(layout, self.stage(module, asked)?), asked)
        };
        let pipelines = pipelines.map_err(|(_, error)| refused("a pipeline")(error))?;
        let pipeline = pipelines.first().copied().unwrap_or_default();
        executable::of_pipeline(self, pipeline, asked)
    }

    fn stage<'m>(
        &self,
        module: &'m SpirvModule,
        stage: vk::ShaderStageFlags,
    ) -> Result<vk::PipelineShaderStageCreateInfo<'m>, LabError> {
        let info = vk::ShaderModuleCreateInfo::default().code(&module.words);
        // SAFETY: the code is valid SPIR-V: naga wrote it from a validated module.
        let made = unsafe { self.device.create_shader_module(&info, None) }
            .map_err(refused("a shader module"))?;
        Ok(vk::PipelineShaderStageCreateInfo::default()
            .stage(stage)
            .module(made)
            .name(&module.entry_point))
    }

    /// A layout with exactly the bindings of the shader, for every stage.
    fn layout(&self, bindings: &[Bound]) -> Result<vk::PipelineLayout, LabError> {
        let mut sets = Vec::new();
        let groups = bindings.iter().map(|bound| bound.group + 1).max();
        for group in 0..groups.unwrap_or(0) {
            let entries: Vec<_> = bindings
                .iter()
                .filter(|bound| bound.group == group)
                .map(|bound| {
                    vk::DescriptorSetLayoutBinding::default()
                        .binding(bound.binding)
                        .descriptor_type(bound.kind)
                        .descriptor_count(1)
                        .stage_flags(vk::ShaderStageFlags::ALL)
                })
                .collect();
            let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&entries);
            // SAFETY: `info` and the entries live through the call; naga has checked that bindings are unique.
            let set = unsafe { self.device.create_descriptor_set_layout(&info, None) }
                .map_err(refused("a descriptor set layout"))?;
            sets.push(set);
        }
        let info = vk::PipelineLayoutCreateInfo::default().set_layouts(&sets);
        // SAFETY: the sets were made from this device and are alive.
        unsafe { self.device.create_pipeline_layout(&info, None) }
            .map_err(refused("a pipeline layout"))
    }

    fn compute(
        &self,
        layout: vk::PipelineLayout,
        stage: vk::PipelineShaderStageCreateInfo<'_>,
    ) -> Made {
        let info = vk::ComputePipelineCreateInfo::default()
            .flags(FLAGS)
            .stage(stage)
            .layout(layout);
        // SAFETY: module and layout are alive, and the layout has every binding of the shader.
        unsafe {
            self.device
                .create_compute_pipelines(vk::PipelineCache::null(), &[info], None)
        }
    }

    /// A triangle without vertex buffers into one sample per pixel, without blending.
    fn fragment(
        &self,
        layout: vk::PipelineLayout,
        stages: &[vk::PipelineShaderStageCreateInfo<'_>],
        (target, targets): (TextureFormat, usize),
    ) -> Made {
        let formats = vec![format(target); targets];
        let blend = vk::PipelineColorBlendAttachmentState::default()
            .color_write_mask(vk::ColorComponentFlags::RGBA);
        let blends = vec![blend; targets];
        let vertices = vk::PipelineVertexInputStateCreateInfo::default();
        let assembly = vk::PipelineInputAssemblyStateCreateInfo::default()
            .topology(vk::PrimitiveTopology::TRIANGLE_LIST);
        let viewport = vk::PipelineViewportStateCreateInfo::default()
            .viewport_count(1)
            .scissor_count(1);
        let raster = vk::PipelineRasterizationStateCreateInfo::default().line_width(1.0);
        let samples = vk::PipelineMultisampleStateCreateInfo::default()
            .rasterization_samples(vk::SampleCountFlags::TYPE_1);
        let blend = vk::PipelineColorBlendStateCreateInfo::default().attachments(&blends);
        let dynamic = vk::PipelineDynamicStateCreateInfo::default()
            .dynamic_states(&[vk::DynamicState::VIEWPORT, vk::DynamicState::SCISSOR]);
        let mut rendering =
            vk::PipelineRenderingCreateInfo::default().color_attachment_formats(&formats);
        let info = vk::GraphicsPipelineCreateInfo::default()
            .flags(FLAGS)
            .stages(stages)
            .vertex_input_state(&vertices)
            .input_assembly_state(&assembly)
            .viewport_state(&viewport)
            .rasterization_state(&raster)
            .multisample_state(&samples)
            .color_blend_state(&blend)
            .dynamic_state(&dynamic)
            .layout(layout)
            .push_next(&mut rendering);
        // SAFETY: modules and layout are alive, the layout has every binding of both stages, and all that `info` points to
        // lives through the call.
        unsafe {
            self.device
                .create_graphics_pipelines(vk::PipelineCache::null(), &[info], None)
        }
    }
}

/// The formats of targets, and of textures, which are bound without one.
fn format(format: TextureFormat) -> vk::Format {
    match format {
        TextureFormat::R8Unorm => vk::Format::R8_UNORM,
        TextureFormat::Rgba8Unorm => vk::Format::R8G8B8A8_UNORM,
        TextureFormat::R16Float => vk::Format::R16_SFLOAT,
        TextureFormat::R32Float => vk::Format::R32_SFLOAT,
        TextureFormat::Rgba16Unorm => vk::Format::R16G16B16A16_UNORM,
        TextureFormat::Rgba16Float => vk::Format::R16G16B16A16_SFLOAT,
        TextureFormat::Rgba32Float => vk::Format::R32G32B32A32_SFLOAT,
        TextureFormat::Rgb10a2Unorm => vk::Format::A2B10G10R10_UNORM_PACK32,
        _ => vk::Format::UNDEFINED,
    }
}
