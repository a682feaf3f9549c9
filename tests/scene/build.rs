//! glTF files part by part, and what is seen of them.

use crate::Files;
use moment_shadows::Profile;
use moment_shadows_lab::command::drawn::Drawn;
use moment_shadows_lab::command::render::RenderOptions;
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::host::{DepthSamples, SurfacePixels, read_depth_samples, read_gbuffer};
use moment_shadows_lab::truth::peel::Peeler;
use serde_json::{Value, json};

pub(crate) const FLOAT: u32 = 5126;

/// A panel's texture coordinates with the whole image on it.
pub(crate) const CORNERS: [[f32; 2]; 4] = [[0.0, 1.0], [1.0, 1.0], [0.0, 0.0], [1.0, 0.0]];

/// An uneven shape without symmetry.
pub(crate) fn is_opaque(x: u32, y: u32) -> bool {
    x + 2 * y > 9 && (x < 5 || y > 4) && x * y < 50
}

/// A texture that is there for its alpha: whether each texel of a square is opaque.
pub(crate) fn picture(side: u32, is_opaque: impl Fn(u32, u32) -> bool) -> Vec<u8> {
    let texel = |x, y| image::Rgba([200, 150, 100, 255 * u8::from(is_opaque(x, y))]);
    let mut png = std::io::Cursor::new(Vec::new());
    let picture = image::RgbaImage::from_fn(side, side, texel);
    picture.write_to(&mut png, image::ImageFormat::Png).unwrap();
    png.into_inner()
}

impl Files {
    /// A file with a block on its ground: what the masks and meshes of tests stand beside.
    pub(crate) fn block() -> Self {
        let mut files = Self::triangle("");
        files.bytes.clear();
        files.document = json!({
            "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [] }], "nodes": [], "meshes": [],
            "accessors": [], "bufferViews": [], "buffers": [{ "uri": "sail.bin", "byteLength": 0 }], "materials": [],
            "images": [], "textures": [], "samplers": [], "extensionsUsed": []
        });
        let block = files.block_mesh();
        files.node(json!({ "mesh": block, "scale": [1.5, 0.2, 1.1] }));
        files
    }

    /// Appends to one of the document's lists; gives the index.
    pub(crate) fn push(&mut self, list: &str, value: Value) -> usize {
        let list = self.document[list].as_array_mut().unwrap();
        list.push(value);
        list.len() - 1
    }

    /// A node of the scene.
    pub(crate) fn node(&mut self, node: Value) -> usize {
        let node = self.push("nodes", node);
        let roots = self.document["scenes"][0]["nodes"].as_array_mut().unwrap();
        roots.push(json!(node));
        node
    }

    /// A view of some bytes.
    pub(crate) fn view(&mut self, bytes: &[u8], stride: Option<usize>) -> usize {
        let offset = self.bytes.len();
        self.bytes.extend(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.document["buffers"][0]["byteLength"] = json!(self.bytes.len());
        let mut view = json!({ "buffer": 0, "byteOffset": offset, "byteLength": bytes.len() });
        if let Some(stride) = stride {
            view["byteStride"] = json!(stride);
        }
        self.push("bufferViews", view)
    }

    /// An accessor of floats.
    pub(crate) fn floats<const N: usize>(&mut self, values: &[[f32; N]]) -> usize {
        let bytes: Vec<u8> = values
            .as_flattened()
            .iter()
            .copied()
            .flat_map(f32::to_le_bytes)
            .collect();
        let view = self.view(&bytes, None);
        let fold = |pick: fn(f32, f32) -> f32| -> Vec<f32> {
            let along = |axis: usize| values.iter().map(|value| value[axis]).reduce(pick).unwrap();
            (0..N).map(along).collect()
        };
        let accessor = json!({
            "bufferView": view, "componentType": FLOAT, "count": values.len(), "type": format!("VEC{N}"),
            "min": fold(f32::min), "max": fold(f32::max)
        });
        self.push("accessors", accessor)
    }

    /// A box with its base at the origin, 2 by 1 by 2 in size: triangles without indices and normals.
    pub(crate) fn block_mesh(&mut self) -> usize {
        let corner = |at: usize| {
            [
                (at & 1) as f32 * 2.0 - 1.0,
                (at >> 1 & 1) as f32,
                (at >> 2) as f32 * 2.0 - 1.0,
            ]
        };
        const FACES: [[usize; 4]; 6] = [
            [0, 1, 2, 3],
            [4, 5, 6, 7],
            [0, 1, 4, 5],
            [2, 3, 6, 7],
            [0, 2, 4, 6],
            [1, 3, 5, 7],
        ];
        let triangles = FACES.map(|[a, b, c, d]| [a, b, c, c, b, d].map(corner));
        let positions = self.floats(triangles.as_flattened());
        self.push(
            "meshes",
            json!({ "primitives": [{ "attributes": { "POSITION": positions } }] }),
        )
    }

    /// A leaning panel, its lower left corner first, that is seen from both sides; `uvs` likewise.
    pub(crate) fn panel(&mut self, uvs: [[f32; 2]; 4], material: usize) -> usize {
        let corners = [
            [-1.3, 0.3, 0.5],
            [1.0, 0.35, -0.4],
            [-1.3, 1.9, 0.1],
            [1.0, 1.95, -0.8],
        ];
        let position = self.floats(&corners);
        let uv = self.floats(&uvs);
        let attributes = json!({ "POSITION": position, "TEXCOORD_0": uv });
        let primitive = json!({ "attributes": attributes, "mode": 5, "material": material });
        self.push("meshes", json!({ "primitives": [primitive] }))
    }

    /// A masked material whose texture has this PNG and this sampler.
    pub(crate) fn masked(&mut self, png: &[u8], sampler: Value) -> usize {
        let view = self.view(png, None);
        let image = self.push(
            "images",
            json!({ "bufferView": view, "mimeType": "image/png" }),
        );
        let sampler = self.push("samplers", sampler);
        let texture = self.push("textures", json!({ "source": image, "sampler": sampler }));
        self.material(json!({ "index": texture }))
    }

    /// A masked material with this base colour texture.
    pub(crate) fn material(&mut self, texture: Value) -> usize {
        let surface = json!({ "baseColorTexture": texture });
        self.push(
            "materials",
            json!({ "alphaMode": "MASK", "doubleSided": true, "pbrMetallicRoughness": surface }),
        )
    }

    /// What a camera, a light and the peeling truth see of the file.
    pub(crate) fn seen(&self, options: &RenderOptions) -> Seen {
        self.load().unwrap();
        let path = self.folder.path().join("sail.gltf");
        let scene = options.load(path.to_str().unwrap()).unwrap();
        let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
        let frame = options
            .frame(&gpu, &scene, &options.sized(Drawn::default()), 4)
            .unwrap();
        let map = frame.desc.map;
        let mut peeled = vec![0; (map[0] * map[1]) as usize];
        let peeler = Peeler::new(&scene, &frame.desc.light, map).unwrap();
        for surface in peeler.rows(0..map[1]) {
            let [x, y] = surface.texel;
            peeled[(y * map[0] + x) as usize] += 1;
        }
        Seen {
            pixels: read_gbuffer(&gpu, &frame.surface).unwrap(),
            depth: read_depth_samples(&gpu, &frame.light_map.texture).unwrap(),
            peeled,
        }
    }
}

/// What is drawn and peeled of a file.
pub(crate) struct Seen {
    pub(crate) pixels: SurfacePixels,
    pub(crate) depth: DepthSamples,
    /// Surfaces on the ray of each texel.
    pub(crate) peeled: Vec<u32>,
}

impl Seen {
    /// How many pixels, samples of depth and rays tell two files apart.
    pub(crate) fn apart(&self, other: &Self) -> [usize; 3] {
        let [a, b] =
            [self, other].map(|seen| seen.pixels.covered.iter().zip(&seen.pixels.position));
        let far = |(a, b): (&f32, &f32)| (a - b).abs() > 1e-3;
        let pixels = a
            .zip(b)
            .filter(|((a, p), (b, q))| a != b || p.iter().zip(q.iter()).any(far));
        let depth = self.depth.values.iter().zip(&other.depth.values);
        let peeled = self.peeled.iter().zip(&other.peeled);
        [
            pixels.count(),
            depth.filter(|&pair| far(pair)).count(),
            peeled.filter(|(a, b)| a != b).count(),
        ]
    }
}

/// Options under which files are compared, whatever their bounds: from the front, with the light from the left.
pub(crate) fn options() -> RenderOptions {
    use glam::DVec3;
    RenderOptions {
        size: Some([320, 180]),
        map: Some(128),
        camera: Some([DVec3::new(1.7, 1.9, 5.0), DVec3::new(0.1, 0.8, 0.0)]),
        light_direction: Some(DVec3::new(0.6, -1.0, -0.55)),
        ..RenderOptions::default()
    }
}

/// Checks that two files look the same, and not like a third one, in which what they say is left out.
pub(crate) fn same(what: &str, said: &Files, reference: &Files, unread: &Files) {
    let [said, reference, unread] = [said, reference, unread].map(|files| files.seen(&options()));
    let apart = said.apart(&reference);
    let unread = unread.apart(&reference);
    println!("{what}: {apart:?} apart, {unread:?} if it were not read");
    // Edges may fall on either side of a pixel's or a sample's centre.
    assert!(
        apart[0] <= 10 && apart[1] <= 10 && apart[2] <= 4,
        "{what}: {apart:?}"
    );
    assert!(
        unread.iter().all(|&count| count > 200),
        "{what}: {unread:?}"
    );
}
