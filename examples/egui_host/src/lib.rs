//! A paint callback of egui: records a plan into egui's encoder, and its last pass darkens what egui's render pass shows.

mod stand_in;

use eframe::egui_wgpu::{self, Callback, CallbackResources, CallbackTrait, RenderState};
use eframe::{egui, wgpu};
use moment_shadows_graph::record::*;
use moment_shadows_graph::{Capabilities, Graph, NodeRegistry, Stage};
use stand_in::{Failure, SIZE, StandIn};

const PASS: &str = "shade/shade";

/// An application with a picture of its own renderer, and a callback that shadows it.
pub struct App(pub egui::TextureId);

impl App {
    /// Makes everything once. What the callback needs goes among egui's resources.
    pub async fn new(egui: &RenderState) -> Result<Self, Failure> {
        let device = &egui.device;
        let host = StandIn::new(egui)?;
        let graph = Graph::parse(include_str!("../shadows.json"), &NodeRegistry::new())?;
        let capabilities = Capabilities::of_device(&egui.adapter, device);
        let plan = graph.compile(&capabilities, &[])?;
        let options = PipelineOptions {
            host_targets: vec![(PASS.to_owned(), HostTarget::darkened(egui.target_format))],
            ..Default::default()
        };
        let pipelines = Pipelines::create(device, &plan, options).await?;
        let resources = Resources::create(device, &plan).await?;
        let (given, buffer) = (host.imports(), host.parameters(egui, &plan)?);
        let bindings =
            Bindings::create(device, &plan, &pipelines, &resources, &given, Some(&buffer));
        let bindings = bindings.await?;
        let mut renderer = egui.renderer.write();
        renderer.callback_resources.insert(bindings);
        let picture = host.picture();
        let picture = renderer.register_native_texture(device, &picture, wgpu::FilterMode::Linear);
        Ok(Self(picture))
    }

    /// Shows the shadowed picture, as large as it fits.
    pub fn show(&self, ui: &mut egui::Ui) -> egui::Response {
        let size = SIZE * (ui.available_size() / SIZE).min_elem();
        let response = ui.add(egui::Image::new((self.0, size)));
        ui.painter()
            .add(Callback::new_paint_callback(response.rect, Shadows));
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
        _: &egui_wgpu::ScreenDescriptor,
        encoder: &mut wgpu::CommandEncoder,
        resources: &mut CallbackResources,
    ) -> Vec<wgpu::CommandBuffer> {
        if let Some(bindings) = resources.get::<Bindings>() {
            let recorded = bindings.record(Stage::AfterShadowMaps, encoder, Recording::default());
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
