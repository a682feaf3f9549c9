//! What becomes of shadows along the border of what a view shows.

/// What becomes of shadows along the border of what a view shows: within its guard band, if it has one. Widths are texels of its
/// region, inwards from there, at most 4095, to a sixteenth. Nodes with the property `borders` do so; to others all are sharp.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Border {
    /// The next view that contains a place shades it, and light beyond the last.
    #[default]
    Sharp,
    /// Over this width the view blends with the next ones that contain a place, as a cascade does with a coarser one. Where none
    /// does it is sharp.
    Blend(f64),
    /// Over this width shadows fade out, as those of the last cascade do.
    Fade(f64),
    /// Over this width shadows fade out towards the circle within the region, outside of which there are none: a spot's cone.
    Cone(f64),
}

/// No border has more texels.
pub(super) const WIDEST: f64 = 4095.0;

impl Border {
    /// The width in texels; 0 for a sharp one.
    #[must_use]
    pub fn width(self) -> f64 {
        match self {
            Border::Sharp => 0.0,
            Border::Blend(width) | Border::Fade(width) | Border::Cone(width) => width,
        }
    }

    /// What the shader is told beside the channel.
    pub(super) fn word(self) -> u32 {
        let flags = match self {
            Border::Sharp | Border::Blend(_) => 0,
            Border::Fade(_) => 16,
            Border::Cone(_) => 16 | 32,
        };
        // A check has found the width to be at most the widest.
        flags | ((16.0 * self.width()).round() as u32) << 16
    }
}
