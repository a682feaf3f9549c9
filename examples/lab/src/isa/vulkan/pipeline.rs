//! One pipeline per shader, made only to be asked.

use ash::vk;

use super::{Executable, NullDevice, executable, refused};
use crate::isa::error::IsaError;
use crate::isa::spirv::{Bound, SpirvModule};
use moment_shadows::TextureFormat;

/// Vulkan objects that are destroyed with the scope they were made in.
struct Objects<'a> {
    device: &'a ash::Device,
    modules: Vec<vk::ShaderModule>,
    sets: Vec<vk::DescriptorSetLayout>,
    layout: vk::PipelineLayout,
    pipeline: vk::Pipeline,
}

impl Drop for Objects<'_> {
    fn drop(&mut self) {
        // SAFETY: every object was made from this device, is destroyed once, and is in no use; null handles are allowed.
        unsafe {
            self.device.destroy_pipeline(self.pipeline, None);
            self.device.destroy_pipeline_layout(self.layout, None);
            for &set in &self.sets {
                self.device.destroy_descriptor_set_layout(set, None);
            }
            for &module in &self.modules {
                self.device.destroy_shader_module(module, None);
            }
        }
    }
}

/// So that the driver keeps the text of what it makes.
const FLAGS: vk::PipelineCreateFlags = vk::PipelineCreateFlags::from_raw(
    vk::PipelineCreateFlags::CAPTURE_STATISTICS_KHR.as_raw()
        | vk::PipelineCreateFlags::CAPTURE_INTERNAL_REPRESENTATIONS_KHR.as_raw(),
);

impl NullDevice {
    /// Compiles a compute shader, or a fragment shader with the vertex shader and the target that it is drawn with, and gives
    /// what the driver says about it.
    pub(in crate::isa) fn compile(
        &self,
        module: &SpirvModule,
        drawn: Option<(&SpirvModule, TextureFormat)>,
    ) -> Result<Executable, IsaError> {
        let mut objects = Objects {
            device: &self.device,
            modules: Vec::new(),
            sets: Vec::new(),
            layout: vk::PipelineLayout::null(),
            pipeline: vk::Pipeline::null(),
        };
        objects.layout(&module.bindings)?;
        let mut stage = |module, flag| objects.stage(module, flag);
        let asked = if let Some((vertex, target)) = drawn {
            let asked = vk::ShaderStageFlags::FRAGMENT;
            let stages = [
                stage(vertex, vk::ShaderStageFlags::VERTEX)?,
                stage(module, asked)?,
            ];
            objects.fragment(&stages, target)?;
            asked
        } else {
            let asked = vk::ShaderStageFlags::COMPUTE;
            let stage = stage(module, asked)?;
            objects.compute(stage)?;
            asked
        };
        executable::of_pipeline(self, objects.pipeline, asked)
    }
}

impl Objects<'_> {
    fn stage<'m>(
        &mut self,
        module: &'m SpirvModule,
        stage: vk::ShaderStageFlags,
    ) -> Result<vk::PipelineShaderStageCreateInfo<'m>, IsaError> {
        let info = vk::ShaderModuleCreateInfo::default().code(&module.words);
        // SAFETY: the code is valid SPIR-V: naga wrote it from a validated module.
        let made = unsafe { self.device.create_shader_module(&info, None) }
            .map_err(refused("a shader module"))?;
        self.modules.push(made);
        Ok(vk::PipelineShaderStageCreateInfo::default()
            .stage(stage)
            .module(made)
            .name(&module.entry_point))
    }

    /// A layout with exactly the bindings of the shader, for every stage.
    fn layout(&mut self, bindings: &[Bound]) -> Result<(), IsaError> {
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
            self.sets.push(set);
        }
        let info = vk::PipelineLayoutCreateInfo::default().set_layouts(&self.sets);
        // SAFETY: the sets were made from this device and are alive.
        self.layout = unsafe { self.device.create_pipeline_layout(&info, None) }
            .map_err(refused("a pipeline layout"))?;
        Ok(())
    }

    fn compute(&mut self, stage: vk::PipelineShaderStageCreateInfo<'_>) -> Result<(), IsaError> {
        let info = vk::ComputePipelineCreateInfo::default()
            .flags(FLAGS)
            .stage(stage)
            .layout(self.layout);
        // SAFETY: module and layout are alive, and the layout has every binding of the shader.
        let pipelines = unsafe {
            self.device
                .create_compute_pipelines(vk::PipelineCache::null(), &[info], None)
        };
        self.take(pipelines)
    }

    /// A triangle without vertex buffers into one sample per pixel, without blending.
    fn fragment(
        &mut self,
        stages: &[vk::PipelineShaderStageCreateInfo<'_>],
        target: TextureFormat,
    ) -> Result<(), IsaError> {
        let formats = [format(target)];
        let blends = [vk::PipelineColorBlendAttachmentState::default()
            .color_write_mask(vk::ColorComponentFlags::RGBA)];
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
            .layout(self.layout)
            .push_next(&mut rendering);
        // SAFETY: modules and layout are alive, the layout has every binding of both stages, and all that `info` points to
        // lives through the call.
        let pipelines = unsafe {
            self.device
                .create_graphics_pipelines(vk::PipelineCache::null(), &[info], None)
        };
        self.take(pipelines)
    }

    fn take(
        &mut self,
        pipelines: Result<Vec<vk::Pipeline>, (Vec<vk::Pipeline>, vk::Result)>,
    ) -> Result<(), IsaError> {
        let (pipelines, result) = match pipelines {
            Ok(pipelines) => (pipelines, Ok(())),
            Err((pipelines, error)) => (pipelines, Err(error)),
        };
        self.pipeline = pipelines.first().copied().unwrap_or_default();
        result.map_err(refused("a pipeline"))
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
