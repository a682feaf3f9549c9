//! Pictures without a window.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::channel;
use std::time::{Duration, Instant};

use bevy::camera::RenderTarget;
use bevy::log::LogPlugin;
use bevy::prelude::*;
use bevy::render::RenderPlugin;
use bevy::render::render_resource::TextureFormat;
use bevy::render::renderer::RenderDevice;
use bevy::render::view::screenshot::{Screenshot, ScreenshotCaptured};
use bevy::window::ExitCondition;
use bevy::winit::WinitPlugin;

use super::{Look, add_to};

/// The scene as an application without a window.
pub struct Stage {
    app: App,
    images: Vec<Handle<Image>>,
}

impl Stage {
    /// A look in pictures of this size. Once it is there, assets are loaded and pipelines compiled.
    #[must_use]
    pub fn new(look: &Look, size: [u32; 2]) -> Self {
        let (app, images) = open(look, size);
        let mut stage = Self { app, images };
        for _ in 0..WARM_UP {
            stage.app.update();
        }
        stage
    }

    /// The median time of some frames, the device's work included.
    pub fn frame_time(&mut self, frames: usize) -> Result<Duration, String> {
        let mut times = Vec::new();
        wait(&self.app)?;
        for _ in 0..frames {
            let start = Instant::now();
            self.app.update();
            wait(&self.app)?;
            times.push(start.elapsed());
        }
        times.sort();
        Ok(times.get(frames / 2).copied().unwrap_or_default())
    }

    /// What each camera sees.
    pub fn pictures(&mut self) -> Result<Vec<Image>, String> {
        let images = self.images.clone();
        let images = images.into_iter();
        images.map(|image| capture(&mut self.app, image)).collect()
    }

    /// The application, to change something in it between frames.
    pub fn app(&mut self) -> &mut App {
        &mut self.app
    }
}

fn open(look: &Look, [width, height]: [u32; 2]) -> (App, Vec<Handle<Image>>) {
    let mut app = App::new();
    let window = WindowPlugin {
        primary_window: None,
        exit_condition: ExitCondition::DontExit,
        ..default()
    };
    let render = RenderPlugin {
        synchronous_pipeline_compilation: true,
        ..default()
    };
    let plugins = DefaultPlugins.set(window).set(render);
    let mut plugins = plugins.disable::<WinitPlugin>();
    // One process has one log.
    if LOGGED.swap(true, Ordering::Relaxed) {
        plugins = plugins.disable::<LogPlugin>();
    } else {
        let level = bevy::log::Level::WARN;
        plugins = plugins.set(LogPlugin { level, ..default() });
    }
    app.add_plugins(plugins);
    let target = || {
        let format = TextureFormat::Rgba8UnormSrgb;
        Image::new_target_texture(width, height, format, None)
    };
    let mut images = app.world_mut().resource_mut::<Assets<Image>>();
    let images: Vec<Handle<Image>> = look.eyes.iter().map(|_| images.add(target())).collect();
    let targets = images
        .iter()
        .map(|image| RenderTarget::Image(image.clone().into()));
    let targets = targets.collect();
    add_to(&mut app, look, targets);
    app.finish();
    app.cleanup();
    (app, images)
}

static LOGGED: AtomicBool = AtomicBool::new(false);

/// Frames until all is there.
const WARM_UP: usize = 4;

/// Waits until the device has drawn what was submitted.
fn wait(app: &App) -> Result<(), String> {
    let device = app.world().resource::<RenderDevice>().wgpu_device();
    let done = device.poll(wgpu::PollType::wait_indefinitely());
    done.map(|_| ()).map_err(|error| error.to_string())
}

fn capture(app: &mut App, image: Handle<Image>) -> Result<Image, String> {
    let (sender, receiver) = channel();
    let world = app.world_mut();
    world
        .spawn(Screenshot::image(image))
        .observe(move |captured: On<ScreenshotCaptured>| {
            // Nobody listens any more once there is a picture.
            let _ = sender.send(captured.image.clone());
        });
    for _ in 0..MOST_FRAMES {
        app.update();
        wait(app)?;
        if let Ok(image) = receiver.try_recv() {
            return Ok(image);
        }
    }
    Err(format!("no picture came within {MOST_FRAMES} frames"))
}

/// Frames until a picture is there, at most.
const MOST_FRAMES: usize = 30;
