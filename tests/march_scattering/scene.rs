//! A roof of panes above a camera, lit from above by each kind of light, with the map of each view and the truth in double precision.

use bytemuck::bytes_of;
use glam::{DMat3, DMat4, DVec3, DVec4};
use moment_shadows::{
    CameraView, DepthRange, HeightFog, LeakReduction, LightDepth, LightView, MapEncoding,
    MarchScatteringParameters, MarchedAir, PointLight, SingleScattering, SpotCone, Storage,
    Technique, TextureFormat, Tile, UpsampleScatteringParameters,
};
use moment_shadows_graph::TextureDesc;
use moment_shadows_lab::gpu::Gpu;
use wgpu::util::DeviceExt as _;

use crate::stage::upload_layers;

pub(crate) const PICTURE: [u32; 2] = [45, 31];
pub(crate) const FAR: f64 = 20.0;
const MAP: u32 = 512;
const ROOF: f64 = 3.0;
const EYE: DVec3 = DVec3::new(0.4, 1.7, 0.3);
const LAMP: DVec3 = DVec3::new(0.7, 5.5, 0.2);
/// Where the lamp's views begin and end.
const RANGE: DepthRange = DepthRange {
    near: 0.5,
    far: 40.0,
};
pub(crate) const CONE: SpotCone = SpotCone {
    inner: 1.2,
    outer: 1.6,
};

/// A kind of light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Lamp {
    Sun,
    Point,
    Spot,
}

/// A camera under the roof, a light above it, and what is in the air.
pub(crate) struct Scene {
    pub(crate) lamp: Lamp,
    pub(crate) views: Vec<LightView>,
    pub(crate) medium: SingleScattering,
    pub(crate) air: MarchedAir,
    forward: DVec3,
}

pub(crate) fn haze(density: f32) -> SingleScattering {
    let extinction = [0.08, 0.1, 0.12].map(|value| value * density);
    let scattering = [0.07, 0.09, 0.1].map(|value| value * density);
    SingleScattering::new(extinction, scattering, 0.3, [3.0; 3]).unwrap()
}

/// From the scene to a camera at `eye` that looks along its -z.
fn looking(eye: DVec3, forward: DVec3, up: DVec3) -> DMat4 {
    let back = -forward.normalize();
    let side = up.cross(back).normalize();
    let rotation = DMat3::from_cols(side, back.cross(side), back);
    DMat4::from_mat3(rotation.transpose()) * DMat4::from_translation(-eye)
}

/// With planes at 0.1 and 100.
fn perspective(field_of_view: f64, aspect: f64) -> DMat4 {
    let y = 1.0 / (0.5 * field_of_view).tan();
    let (near, far) = (0.1, 100.0);
    DMat4::from_cols(
        DVec4::new(y / aspect, 0.0, 0.0, 0.0),
        DVec4::new(0.0, y, 0.0, 0.0),
        DVec4::new(0.0, 0.0, far / (near - far), -1.0),
        DVec4::new(0.0, 0.0, near * far / (near - far), 0.0),
    )
}

fn sun() -> LightView {
    let direction = DVec3::new(0.3, -1.0, 0.2);
    let eye = -30.0 * direction.normalize();
    let box_of_map = DMat4::from_scale(DVec3::new(1.0 / 26.0, 1.0 / 26.0, -1.0 / 60.0));
    let clip = box_of_map * looking(eye, direction, DVec3::X);
    LightView::orthographic(clip.to_cols_array_2d())
}

fn lamp() -> PointLight {
    PointLight {
        position: LAMP.to_array(),
        depth: LightDepth::Perspective {
            near: RANGE.near,
            far: RANGE.far,
            reversed: false,
            range: RANGE,
        },
        tile: Tile {
            texels: MAP,
            filter_radius: 1.0,
        },
        nearest_caster: None,
    }
}

impl Scene {
    /// Thin haze that is twice as thin every three units above the ground.
    pub(crate) fn new(lamp_kind: Lamp) -> Self {
        let placed = |(layer, view): (u32, LightView)| LightView {
            layer,
            region: moment_shadows::MapRegion::WHOLE,
            ..view
        };
        let (views, cone) = match lamp_kind {
            Lamp::Sun => (vec![sun()], None),
            Lamp::Point => {
                let faces = lamp().faces().unwrap();
                ((0..).zip(faces).map(placed).collect(), None)
            }
            Lamp::Spot => {
                let spot = lamp().spot([0.1, -1.0, 0.2], CONE.outer).unwrap();
                (vec![placed((0, spot))], Some(CONE))
            }
        };
        let brighter = if lamp_kind == Lamp::Sun { 1.0 } else { 20.0 };
        let mut medium = haze(1.0);
        medium.irradiance = medium.irradiance.map(|it| brighter * it);
        let fog = HeightFog {
            falloff: 0.23,
            ..HeightFog::NONE
        };
        Self {
            lamp: lamp_kind,
            views,
            medium,
            air: MarchedAir {
                fog,
                cone,
                ..MarchedAir::default()
            },
            forward: DVec3::new(1.0, 0.25, 0.4),
        }
    }

    fn clip_from_world(&self) -> DMat4 {
        perspective(1.1, 1.5) * looking(EYE, self.forward, DVec3::Y)
    }

    pub(crate) fn camera(&self) -> CameraView {
        CameraView {
            clip_from_world: self.clip_from_world().to_cols_array_2d(),
            far_depth: 1.0,
        }
    }

    /// The structs of the marching node, one after the other.
    pub(crate) fn parameters(&self) -> Vec<u8> {
        let structs = self.views.iter().map(|view| {
            MarchScatteringParameters::new(
                &self.camera(),
                FAR,
                view,
                self.medium,
                &self.air,
                LeakReduction::NONE,
            )
            .unwrap()
        });
        structs.flat_map(|it| bytes_of(&it).to_vec()).collect()
    }

    pub(crate) fn upsampling(&self) -> UpsampleScatteringParameters {
        UpsampleScatteringParameters::new(&self.camera(), FAR).unwrap()
    }

    /// The stored depth of the first caster on the light ray through a place of a view's map; 1 without one.
    fn stored(view: &LightView, u: f64, v: f64) -> f64 {
        let clip = DMat4::from_cols_array_2d(&view.clip_from_world);
        let world_from_clip = clip.inverse();
        let at =
            |z: f64| world_from_clip.project_point3(DVec3::new(2.0 * u - 1.0, 1.0 - 2.0 * v, z));
        let (near, far) = (at(0.0), at(1.0));
        let part = (ROOF - near.y) / (far.y - near.y);
        let hit = near + part * (far - near);
        if part > 0.0 && part < 1.0 && covered(hit) {
            clip.project_point3(hit).z
        } else {
            1.0
        }
    }

    /// Each texel of each layer: the depth at its middle.
    fn depths(&self) -> Vec<f64> {
        let texel = |index: u32| (f64::from(index) + 0.5) / f64::from(MAP);
        let layer = |view: &LightView| -> Vec<f64> {
            let texels = (0..MAP * MAP).map(|index| (texel(index % MAP), texel(index / MAP)));
            texels.map(|(u, v)| Self::stored(view, u, v)).collect()
        };
        self.views.iter().flat_map(layer).collect()
    }

    /// The map as four moments in float32, not filtered.
    pub(crate) fn moments(&self, gpu: &Gpu) -> (TextureDesc, wgpu::Texture) {
        let depth = self.views[0].depth;
        let moment_depth = |stored: f64| match depth {
            LightDepth::Orthographic { .. } => 2.0 * stored - 1.0,
            _ => {
                let DepthRange { near, far } = RANGE;
                let distance = near * far / (far - stored * (far - near));
                2.0 * (distance - near) / (far - near) - 1.0
            }
        };
        let moments = |stored: f64| {
            let z = moment_depth(stored);
            [z, z * z, z.powi(3), z.powi(4)].map(|it| it as f32)
        };
        let channels: Vec<[f32; 4]> = self.depths().into_iter().map(moments).collect();
        let encoding = MapEncoding::new(Technique::Hamburger4, Storage::Float32).unwrap();
        upload_layers(gpu, &encoding, [MAP; 2], self.views.len() as u32, &channels)
    }

    /// The plain depth map, in 16 bits.
    pub(crate) fn depth_map(&self, gpu: &Gpu) -> (TextureDesc, wgpu::Texture) {
        let layers = self.views.len() as u32;
        let (mut desc, texture) = depth16(gpu, [MAP; 2], layers, &self.depths());
        desc.layers = layers;
        (desc, texture)
    }

    /// The camera's depth: a wall `distance` along its axis in the left part of the picture, and sky.
    pub(crate) fn camera_depth(
        &self,
        gpu: &Gpu,
        columns: u32,
        distance: f64,
    ) -> (TextureDesc, wgpu::Texture) {
        let wall = stored_by_camera(distance);
        let [width, height] = PICTURE;
        let pixels =
            (0..width * height).map(|index| if index % width < columns { wall } else { 1.0 });
        depth16(gpu, PICTURE, 1, &pixels.collect::<Vec<_>>())
    }

    /// Radiance by colour with shadows and without, and the mean transmittance, of the pixels of a picture with that wall.
    pub(crate) fn truth(&self, columns: u32, distance: f64) -> Vec<([f64; 3], [f64; 3], f64)> {
        // As 16 bits have it.
        let stored = (stored_by_camera(distance) * 65535.0).round() / 65535.0;
        let distance = 0.1 * 100.0 / (100.0 - stored * (100.0 - 0.1));
        let world_from_clip = self.clip_from_world().inverse();
        let axis = self.forward.normalize();
        let [width, height] = PICTURE;
        (0..width * height)
            .map(|index| {
                let [x, y] = [index % width, index / width].map(|place| f64::from(place) + 0.5);
                let device = DVec3::new(
                    2.0 * x / f64::from(width) - 1.0,
                    1.0 - 2.0 * y / f64::from(height),
                    0.5,
                );
                let ray = (world_from_clip.project_point3(device) - EYE).normalize();
                let end = if index % width < columns {
                    distance
                } else {
                    FAR
                };
                self.marched(ray, end / ray.dot(axis))
            })
            .collect()
    }

    fn marched(&self, ray: DVec3, length: f64) -> ([f64; 3], [f64; 3], f64) {
        const STEPS: usize = 1024;
        let medium = &self.medium;
        let fog = self.air.fog;
        let density = |at: DVec3| (-fog.falloff * (at.y - fog.height)).exp();
        let step = length / STEPS as f64;
        let (mut thickness, mut lit, mut all) = (0.0, [0.0; 3], [0.0; 3]);
        for index in 0..STEPS {
            let at = EYE + ray * (index as f64 + 0.5) * step;
            let within = density(at) * step;
            let (light, irradiance, way) = self.light(at);
            let g = f64::from(medium.anisotropy);
            let cosine = -ray.dot(light);
            let phase = (1.0 - g * g)
                / (4.0 * core::f64::consts::PI * (1.0 + g * g - 2.0 * g * cosine).powf(1.5));
            let shadow = self.is_shadowed(at, light);
            for colour in 0..3 {
                let [extinction, scattering, given] =
                    [medium.extinction, medium.scattering, medium.irradiance]
                        .map(|value| f64::from(value[colour]));
                let dimmed = (-extinction * (thickness + 0.5 * within + way)).exp();
                let part = phase * scattering * given * irradiance * dimmed * within;
                all[colour] += part;
                lit[colour] += if shadow { 0.0 } else { part };
            }
            thickness += within;
        }
        let through = medium
            .extinction
            .map(|it| (-f64::from(it) * thickness).exp());
        (lit, all, through.iter().sum::<f64>() / 3.0)
    }

    /// Where light travels to at a position, its irradiance, and the optical thickness per extinction on its way.
    fn light(&self, at: DVec3) -> (DVec3, f64, f64) {
        if self.lamp == Lamp::Sun {
            return (DVec3::new(0.3, -1.0, 0.2).normalize(), 1.0, 0.0);
        }
        let away = at - LAMP;
        let direction = away.normalize();
        let mut irradiance = 1.0 / (away.length_squared() + (FAR / 1024.0).powi(2));
        if self.lamp == Lamp::Spot {
            let cosine = direction.dot(DVec3::new(0.1, -1.0, 0.2).normalize());
            let [inner, outer] = [CONE.inner, CONE.outer].map(|angle| (0.5 * angle).cos());
            irradiance *= ((cosine - outer) / (inner - outer)).clamp(0.0, 1.0).powi(2);
        }
        let HeightFog {
            falloff, height, ..
        } = self.air.fog;
        let fall = falloff * (LAMP.y - at.y);
        let mean = if fall.abs() < 1e-9 {
            1.0
        } else {
            -(-fall).exp_m1() / fall
        };
        (
            direction,
            irradiance,
            (-falloff * (at.y - height)).exp() * mean * away.length(),
        )
    }

    fn is_shadowed(&self, at: DVec3, light: DVec3) -> bool {
        let above = if self.lamp == Lamp::Sun {
            f64::INFINITY
        } else {
            LAMP.y
        };
        if at.y >= ROOF || above <= ROOF {
            return false;
        }
        covered(at + light * ((ROOF - at.y) / light.y))
    }
}

/// The depth that the camera stores at a distance along its axis.
fn stored_by_camera(distance: f64) -> f64 {
    (100.0 - 0.1 * 100.0 / distance) / (100.0 - 0.1)
}

/// Square panes of 1.5 units and gaps of 1.5 between them.
fn covered(at: DVec3) -> bool {
    let pane = |place: f64| (place / 1.5).floor().rem_euclid(2.0) < 1.0;
    pane(at.x) || pane(at.z)
}

/// A depth map of 16 bits: what can be written to it.
fn depth16(gpu: &Gpu, size: [u32; 2], layers: u32, depths: &[f64]) -> (TextureDesc, wgpu::Texture) {
    let bytes: Vec<u8> = depths
        .iter()
        .flat_map(|depth| ((depth * 65535.0).round() as u16).to_le_bytes())
        .collect();
    let texture = gpu.device.create_texture_with_data(
        &gpu.queue,
        &wgpu::TextureDescriptor {
            label: Some("depth"),
            size: wgpu::Extent3d {
                width: size[0],
                height: size[1],
                depth_or_array_layers: layers,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Depth16Unorm,
            usage: wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        },
        wgpu::util::TextureDataOrder::LayerMajor,
        &bytes,
    );
    (TextureDesc::new(TextureFormat::Depth16Unorm, size), texture)
}
