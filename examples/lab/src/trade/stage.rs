//! A scene with its views, and the truths of what each shows.

use glam::DVec3;
use moment_shadows::TextureFormat;
use moment_shadows_graph::TextureDesc;

use super::axes::{Axes, Cell};
use super::crop::Crop;
use super::measure::Measured;
use super::probe::ViewProbe;
use super::results::Setting;
use super::setup::ViewSetup;
use crate::error::LabError;
use crate::frame::{Frame, FrameDesc};
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::host::{SurfacePixels, read_gbuffer};
use crate::judgement::{PictureTruth, facing};
use crate::light::LightShape;
use crate::scene::Scene;
use crate::surface_error::SurfaceTruth;
use crate::texture::upload;
use crate::truth::kernel::{TapPattern, even_positions};
use crate::truth::pcf::pcf;

/// A difference of this shadow intensity has the full colour in crops.
const FULL: f32 = 0.5;

/// A scene that is judged from several views.
pub struct Stage<'a> {
    pub(super) gpu: &'a Gpu,
    /// The graph whose kernel and technique are replaced.
    pub(super) file: &'a GraphFile,
    pub(super) axes: &'a Axes,
    pub(super) setting: &'a Setting,
    pub(super) scene: &'a Scene,
    pub(super) views: Vec<View>,
}

/// A camera and a light, with truths for each softness.
pub(super) struct View {
    pub(super) number: u32,
    desc: FrameDesc,
    /// In the order of the axes' radii.
    pub(super) truths: Vec<ViewTruth>,
    pub(super) probe: ViewProbe,
}

/// What a view should show with one softness.
pub(super) struct ViewTruth {
    pub(super) picture: PictureTruth,
    /// The picture that it lights, as sRGB bytes with alpha.
    pub(super) lit: Vec<u8>,
    pub(super) surfaces: SurfaceTruth,
}

impl<'a> Stage<'a> {
    /// A scene on a device, with a graph whose axes are varied; without its views yet.
    #[must_use]
    pub fn of(
        gpu: &'a Gpu,
        (file, axes): (&'a GraphFile, &'a Axes),
        setting: &'a Setting,
        scene: &'a Scene,
    ) -> Self {
        Self {
            gpu,
            file,
            axes,
            setting,
            scene,
            views: Vec::new(),
        }
    }

    /// Draws all views and computes their truths. Takes seconds per view.
    pub fn with_views(mut self, setups: &[ViewSetup]) -> Result<Self, LabError> {
        for (number, setup) in (self.setting.views[1]..).zip(setups) {
            let view = self.view(number, setup);
            self.views.push(view.map_err(|error| {
                LabError::refused(format!("{}, view {number}: {error}", self.scene.name))
            })?);
        }
        Ok(self)
    }

    /// What all views ask for.
    pub fn probes(&self, setups: &[ViewSetup]) -> Result<Vec<ViewProbe>, LabError> {
        let probe = |(number, setup)| Ok(self.drawn(number, setup)?.probe);
        (self.setting.views[1]..).zip(setups).map(probe).collect()
    }

    /// Every view with a light's map of another size, drawn.
    pub(super) fn frames(&self, map: u32, samples: u32) -> Result<Vec<Frame>, LabError> {
        let frame = |view: &View| {
            let desc = FrameDesc {
                map: [map; 2],
                samples,
                ..view.desc
            };
            Frame::draw(self.gpu, self.scene, desc)
        };
        self.views.iter().map(frame).collect()
    }

    /// The part of the worst view where a combination errs most.
    pub(super) fn crop(&self, measured: &Measured, cell: Cell) -> Result<Crop, LabError> {
        let view = &self.views[measured.worst];
        let truth = &view.truths[self.axes.softness(cell)].picture;
        let width = self.setting.picture[0];
        let pictures = [&*measured.picture, &*truth.shadow];
        Crop::of((view.number, width), pictures, &truth.facing, FULL)
    }

    /// What a view draws for truths.
    fn desc(&self, setup: &ViewSetup) -> Result<FrameDesc, LabError> {
        let [width, height] = self.setting.picture;
        let mut camera = setup.camera(self.scene)?;
        camera.aspect = f64::from(width) / f64::from(height.max(1));
        let map = [self.axes.largest_map(); 2];
        let light = setup.light(self.scene, &camera, (map, self.axes.margin()))?;
        Ok(FrameDesc {
            picture: self.setting.picture,
            map,
            samples: 1,
            format: wgpu::TextureFormat::Depth32Float,
            camera_depth: (wgpu::TextureFormat::Depth32Float, 1),
            shape: LightShape::usual(&light),
            light,
            camera,
        })
    }

    /// A view with its truths for each softness: whatever a map's size and samples, they are those of the largest map with as many
    /// samples as the setting says.
    fn view(&self, number: u32, setup: &ViewSetup) -> Result<View, LabError> {
        let Drawn {
            frame,
            kernels,
            pixels,
            facing,
            probe,
        } = self.drawn(number, setup)?;
        let desc = frame.desc;
        let positions = even_positions(self.setting.truth_samples);
        let depths = frame.light_samples(self.gpu, &positions)?;
        let stride = self.setting.stride;
        let surfaces = SurfaceTruth::of(self.scene, &frame, &depths, &kernels, stride, || ())?;
        let of_kernel = |(taps, surfaces): (&TapPattern, SurfaceTruth)| {
            let shadow = pcf(&desc.light, &depths, taps, &pixels)?;
            let size = self.setting.picture;
            let texture = TextureDesc::new(TextureFormat::R32Float, size);
            let texture = upload(self.gpu, &texture, bytemuck::cast_slice(&shadow));
            Ok(ViewTruth {
                lit: frame.picture(self.gpu, &texture)?,
                picture: PictureTruth {
                    shadow,
                    facing: facing.clone(),
                },
                surfaces,
            })
        };
        let truths: Result<_, LabError> = kernels.iter().zip(surfaces).map(of_kernel).collect();
        Ok(View {
            number,
            desc,
            truths: truths?,
            probe,
        })
    }

    /// A view as it is drawn, and what it asks for.
    pub(crate) fn drawn(&self, number: u32, setup: &ViewSetup) -> Result<Drawn, LabError> {
        let desc = self.desc(setup)?;
        let frame = Frame::draw(self.gpu, self.scene, desc)?;
        let mut kernels = Vec::new();
        for &radius in &self.axes.radii {
            let file = self.axes.blurred(self.file, desc.map[0], radius)?;
            let kernel = file.kernel()?;
            kernels
                .push(kernel.map_or_else(TapPattern::unblurred, |it| TapPattern::of_kernel(&it)));
        }
        let pixels = read_gbuffer(self.gpu, &frame.surface)?;
        let mut facing = facing(&desc.light, &pixels);
        if let Some([near, far]) = setup.part() {
            for (facing, position) in facing.iter_mut().zip(&pixels.position) {
                let distance = (desc.camera).distance(DVec3::from(position.map(f64::from)));
                *facing &= near <= distance && distance < far;
            }
        }
        let depths = frame.light_samples(self.gpu, &even_positions(1))?;
        let probe = ViewProbe::of(number, &desc, &depths, &kernels, &pixels, &facing);
        Ok(Drawn {
            frame,
            kernels,
            pixels,
            facing,
            probe,
        })
    }
}

/// A view before its truths are known.
pub(crate) struct Drawn {
    pub(crate) frame: Frame,
    /// For each softness.
    pub(crate) kernels: Vec<TapPattern>,
    pub(crate) pixels: SurfacePixels,
    pub(crate) facing: Vec<bool>,
    probe: ViewProbe,
}
