//! Hard shadows in an egui window: a paint callback records a plan into egui's encoder, and draws its last pass into egui's
//! open render pass, where it darkens the picture below.

mod stand_in;

use std::error::Error;

use eframe::egui_wgpu::{
    Callback, CallbackResources, CallbackTrait, RenderState, ScreenDescriptor,
};
use eframe::{egui, wgpu};
use moment_shadows_graph::record::*;
use moment_shadows_graph::{Capabilities, Graph, Imports, NodeRegistry, Stage, compile};
use pollster::block_on;
use stand_in::{SIZE, StandIn};

const GRAPH: &str = include_str!("../shadows.json");
const PASS: &str = "shade/shade";

/// An application with a picture of its own renderer, and a callback that shadows it.
pub struct App {
    pub picture: egui::TextureId,
}

impl App {
    /// Makes everything once. What the callback needs goes among egui's resources.
    pub fn new(egui: &RenderState) -> Result<Self, Box<dyn Error + Send + Sync>> {
        let device = &egui.device;
        let host = StandIn::new(egui)?;
        let graph = Graph::parse(GRAPH, &NodeRegistry::new())?;
        let capabilities = Capabilities::of_device(&egui.adapter, device);
        let plan = compile(&graph, &capabilities, &Imports::new())?;
        let options = PipelineOptions {
            host_targets: &[(PASS, HostTarget::darkened(egui.target_format))],
            ..Default::default()
        };
        let pipelines = block_on(Pipelines::create(device, &plan, options))?;
        let resources = block_on(Resources::create(device, &plan))?;
        let parameters = host.parameters(egui, &plan)?;
        let bindings = block_on(Bindings::create(
            device,
            &plan,
            &pipelines,
            &resources,
            &host.imports(),
            Some(&parameters),
        ))?;
        let mut renderer = egui.renderer.write();
        renderer.callback_resources.insert(bindings);
        let picture = host.picture();
        let picture = renderer.register_native_texture(device, &picture, wgpu::FilterMode::Linear);
        Ok(Self { picture })
    }

    /// Shows the shadowed picture, as large as it fits.
    pub fn show(&self, ui: &mut egui::Ui) -> egui::Response {
        let size = egui::Vec2::from(SIZE.map(|side| side as f32));
        let size = size * (ui.available_size() / size).min_elem();
        let image = egui::Image::new((self.picture, size));
        let response = ui.add(image);
        let callback = Callback::new_paint_callback(response.rect, Shadows);
        ui.painter().add(callback);
        response
    }
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut egui::Ui, _: &mut eframe::Frame) {
        self.show(ui);
    }
}

struct Shadows;

impl CallbackTrait for Shadows {
    fn prepare(
        &self,
        _: &wgpu::Device,
        _: &wgpu::Queue,
        _: &ScreenDescriptor,
        encoder: &mut wgpu::CommandEncoder,
        resources: &mut CallbackResources,
    ) -> Vec<wgpu::CommandBuffer> {
        if let Some(bindings) = resources.get::<Bindings>() {
            let recording = Recording::default();
            let recorded = bindings.record(Stage::AfterShadowMaps, encoder, recording);
            recorded.unwrap_or_else(|error| eprintln!("{error}"));
        }
        Vec::new()
    }

    fn paint(
        &self,
        _: egui::PaintCallbackInfo,
        pass: &mut wgpu::RenderPass<'static>,
        resources: &CallbackResources,
    ) {
        if let Some(bindings) = resources.get::<Bindings>() {
            let drawn = bindings.draw(PASS, pass, 0);
            drawn.unwrap_or_else(|error| eprintln!("{error}"));
        }
    }
}
