//! What papers say, a row each: where it is said, in our words, and which figures it is about.

use super::evidence::Figure::{
    self, Air, AirTime, Growth, Leaking, Picture, Soft, SoftTime, Surfaces, Time,
};
use super::evidence::Place::{All, LargestMap, LargestPicture, WidestFilter};

/// Something that a paper says of two techniques, as a comparison of figures.
#[derive(Clone, Copy, Debug)]
pub struct Claim {
    /// What it is about.
    pub topic: &'static str,
    /// The paper, and where in it.
    pub source: &'static str,
    /// What it says, in our words.
    pub says: &'static str,
    /// What should have the smaller figure. Techniques that are judged on scenes have their storage behind their name.
    pub one: &'static str,
    /// What it is compared with.
    pub other: &'static str,
    /// It holds at a place where the figure of `one` is at most so many times that of `other`.
    pub at_most: f64,
    /// Which figure.
    pub figure: Figure,
}

const ORDER: &str = "Moments against variance and exponents, at equal bits";
const STORAGE: &str = "Storage";
const LEAKS: &str = "Light leaks";
const LAYERS: &str = "Layers and convolution";
const AIR: &str = "Light in the air";
const SOFT: &str = "Soft shadows";
const TIME: &str = "Time";

const I3D15: &str = "Peters & Klein 2015, section 4";
const I3D15_STORAGE: &str = "Peters & Klein 2015, section 3.2";
const I3D15_HAUSDORFF: &str = "Peters & Klein 2015, section 2.4";
const I3D15_TIME: &str = "Peters & Klein 2015, figure 1";
const JCGT17: &str = "Peters et al. 2017, section 1";
const JCGT17_SOFT: &str = "Peters et al. 2017, section 5";
const JCGT17_AIR: &str = "Peters et al. 2017, section 7";
const I3D16: &str = "Peters et al. 2016, supplement";
const HPG17: &str = "Peters 2017, abstract";
const GDC16: &str = "Peters, GDC 2016";
const GI08: &str = "Lauritzen & McCool 2008, abstract";
const LAYERED: &str = "Lauritzen 2008, section 4.1";
const EXPONENTIAL: &str = "Lauritzen 2008, section 4.2";
const VSM08: &str = "Lauritzen 2008, chapter 3";

const FEWER: &str = "four moments in 64 bits err less than other filterable maps";
const LEAST: &str = "four moments in 128 bits err less than other filterable maps";
const AS_GOOD: &str = "16 bits per moment are nearly as good as 32";
const LAYERED_LEAKS: &str = "layers leak less light than variance alone";
const MEMORY: &str = "layers err less than a convolution map of the same size";
const SHAFTS: &str = "two fetches are worth 128 steps of marching";

/// Rows of the table: topic, source, claim, and which figure of what is at most so many times that of what.
macro_rules! claims {
    ($($topic:ident, $source:ident, $says:expr => $figure:expr, $one:literal <= $at_most:literal * $other:literal;)*) => {
        /// All claims, topic by topic.
        pub const CLAIMS: &[Claim] = &[$(Claim {
            topic: $topic,
            source: $source,
            says: $says,
            one: $one,
            other: $other,
            at_most: $at_most,
            figure: $figure,
        }),*];
    };
}

claims! {
    ORDER, JCGT17, FEWER => Picture, "hamburger4 unorm16" <= 1.0 * "evsm4 float16";
    ORDER, JCGT17, FEWER => Picture, "hamburger4 float16" <= 1.0 * "evsm4 float16";
    ORDER, JCGT17, LEAST => Picture, "hamburger4 float32" <= 1.0 * "evsm4 float32";
    ORDER, JCGT17, FEWER => Picture, "hamburger4 unorm16" <= 1.0 * "evsm2 float32";
    ORDER, I3D15, FEWER => Picture, "hamburger4 unorm16" <= 1.0 * "vsm float32";
    ORDER, I3D15, FEWER => Picture, "hamburger4 float16" <= 1.0 * "vsm float32";
    ORDER, I3D15, "four moments err less than one exponential" => Picture, "hamburger4 unorm16" <= 1.0 * "esm float32";
    ORDER, I3D15_HAUSDORFF, "bounding depth as well gains too little to be worth its noise" => Picture, "hamburger4 unorm16" <= 1.02 * "hausdorff4 unorm16";
    ORDER, I3D16, "six moments err less than four" => Picture, "hamburger6 float32" <= 1.0 * "hamburger4 float32";
    ORDER, I3D16, "six moments fit 10 bits each" => Picture, "hamburger6 unorm10" <= 1.0 * "hamburger4 unorm16";
    ORDER, I3D16, "six moments fit 10 bits each" => Picture, "hamburger6 unorm10" <= 1.1 * "hamburger6 unorm16";
    STORAGE, I3D15_STORAGE, AS_GOOD => Picture, "hamburger4 unorm16" <= 1.1 * "hamburger4 float32";
    STORAGE, HPG17, "16 bits per moment leak noticeably more than 32" => Leaking, "hamburger4 float32" <= 0.9 * "hamburger4 unorm16";
    STORAGE, GI08, "layers do with 16 bits per channel" => Picture, "lvsm unorm16" <= 1.05 * "lvsm float32";
    LEAKS, JCGT17, "four moments in 64 bits leak less than exponential variance" => Leaking, "hamburger4 unorm16" <= 1.0 * "evsm4 float16";
    LEAKS, JCGT17, "four moments in 64 bits leak less than exponential variance" => Leaking, "hamburger4 float16" <= 1.0 * "evsm4 float16";
    LEAKS, JCGT17, "four moments in 128 bits leak less than exponential variance" => Leaking, "hamburger4 float32" <= 1.0 * "evsm4 float32";
    LEAKS, EXPONENTIAL, "exponential variance leaks less than variance" => Leaking, "evsm4 float32" <= 1.0 * "vsm float32";
    LEAKS, EXPONENTIAL, "exponential variance leaks less than layers of the same size" => Leaking, "evsm4 float32" <= 1.0 * "lvsm unorm16";
    LAYERS, LAYERED, LAYERED_LEAKS => Leaking, "lvsm unorm16" <= 1.0 * "vsm unorm16";
    LAYERS, LAYERED, LAYERED_LEAKS => Picture, "lvsm unorm16" <= 1.0 * "vsm unorm16";
    LAYERS, LAYERED, MEMORY => Picture, "lvsm unorm16" <= 1.0 * "convolution unorm8";
    LAYERS, LAYERED, MEMORY => Surfaces, "lvsm unorm16" <= 1.0 * "convolution unorm8";
    AIR, GDC16, SHAFTS => Air, "6 moments float16" <= 1.25 * "march 128";
    AIR, GDC16, "two fetches take less time than 128 steps" => AirTime, "6 moments float16" <= 1.0 * "march 128";
    AIR, JCGT17_AIR, "six moments err less than four" => Air, "6 moments float16" <= 1.0 * "4 moments float16";
    AIR, GDC16, "10 bits per moment suffice" => Air, "6 moments unorm10" <= 1.1 * "6 moments float16";
    AIR, GDC16, "64 bits of six moments are as good as 256 of a convolution map" => Air, "6 moments unorm10" <= 1.1 * "convolution";
    SOFT, JCGT17_SOFT, "moment soft shadows are as good as percentage-closer ones" => Soft, "moment soft" <= 1.1 * "pcss 9x9";
    SOFT, GDC16, "moment soft shadows take less time than percentage-closer ones" => SoftTime, "moment soft" <= 1.0 * "pcss 9x9";
    TIME, I3D15_TIME, "four moments take less time than percentage-closer filtering" => Time(All), "hamburger4 unorm16" <= 1.0 * "pcf, comparison samplers";
    TIME, I3D15_TIME, "two moments take less time than four" => Time(All), "vsm unorm16" <= 1.0 * "hamburger4 unorm16";
    TIME, GDC16, "where the map is large, percentage-closer filtering takes less" => Time(LargestMap), "pcf, comparison samplers" <= 1.0 * "hamburger4 unorm16";
    TIME, GDC16, "where the picture is large, four moments take less" => Time(LargestPicture), "hamburger4 unorm16" <= 1.0 * "pcf, comparison samplers";
    TIME, GDC16, "where the filter is wide, four moments take less" => Time(WidestFilter), "hamburger4 unorm16" <= 1.0 * "pcf, comparison samplers";
    TIME, VSM08, "with the filter's width percentage-closer filtering grows as its square, two moments in proportion" => Growth, "vsm unorm16" <= 0.6 * "pcf";
    TIME, LAYERED, "layers take less time than a convolution map of the same size" => Time(All), "lvsm unorm16" <= 1.0 * "convolution unorm8";
    TIME, EXPONENTIAL, "exponential variance takes less time than layers of the same size" => Time(All), "evsm4 float32" <= 1.0 * "lvsm unorm16";
}
