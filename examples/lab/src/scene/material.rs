//! The little of materials that shadows need.

/// A picture in memory.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    /// Texels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Red, green and blue in sRGB, alpha linear; a byte each, top row first.
    pub rgba: Vec<u8>,
}

/// How a surface looks and where it has holes.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Name, for messages.
    pub name: String,
    /// Linear red, green, blue and alpha, multiplied with the texture.
    pub base_colour: [f32; 4],
    /// Index of the base colour image in the scene.
    pub texture: Option<usize>,
    /// How the image goes on beyond its edges, along u and v.
    pub wrap: [wgpu::AddressMode; 2],
    /// What lies between the centres of the image's texels: the nearest one, or a blend.
    pub filter: wgpu::FilterMode,
    /// The alpha below which a point is a hole; `None` for an opaque surface. A point's alpha is the product of that of
    /// `base_colour`, the vertices' and the image's at its full size: means of alpha, as mips hold, are no mask.
    pub mask: Option<f32>,
    /// Whether alpha is how much light is kept, as glTF's `BLEND` has it. The host draws such a surface as an opaque one: what blends it
    /// is [`translucent`](crate::translucent).
    pub blend: bool,
    /// Whether both sides are meant to be seen. The host always draws both.
    pub double_sided: bool,
}

impl Material {
    /// An opaque surface of one colour (linear).
    pub fn plain(name: &str, [red, green, blue]: [f32; 3]) -> Self {
        Self {
            name: name.to_owned(),
            base_colour: [red, green, blue, 1.0],
            texture: None,
            wrap: [wgpu::AddressMode::Repeat; 2],
            filter: wgpu::FilterMode::Linear,
            mask: None,
            blend: false,
            double_sided: false,
        }
    }
}
