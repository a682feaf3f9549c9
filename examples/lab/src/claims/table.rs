//! What papers say, a row each: where it is said, in our words, and which figures it is about.

use super::evidence::{Figure, Place};

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

const fn row(
    [topic, source, says]: [&'static str; 3],
    [one, other]: [&'static str; 2],
    at_most: f64,
    figure: Figure,
) -> Claim {
    Claim {
        topic,
        source,
        says,
        one,
        other,
        at_most,
        figure,
    }
}

const FEWER: &str = "four moments in 64 bits err less than other filterable maps";
const LEAST: &str = "four moments in 128 bits err less than other filterable maps";
const AS_GOOD: &str = "16 bits per moment are nearly as good as 32";
const UNBLED: &str = "layers keep light from bleeding from one into another";
const MEMORY: &str = "layers err less than a convolution map of the same size";
const SHAFTS: &str = "two fetches are worth 128 steps of marching";

/// All claims, topic by topic.
pub const CLAIMS: [Claim; 36] = {
    use Figure::{Air, AirTime, Growth, Leaking, Picture, Soft, SoftTime, Surfaces, Time};
    use Place::{All, LargestMap, LargestPicture, WidestFilter};
    [
        row(
            [ORDER, JCGT17, FEWER],
            ["hamburger4 unorm16", "evsm4 float16"],
            1.0,
            Picture,
        ),
        row(
            [ORDER, JCGT17, FEWER],
            ["hamburger4 float16", "evsm4 float16"],
            1.0,
            Picture,
        ),
        row(
            [ORDER, JCGT17, LEAST],
            ["hamburger4 float32", "evsm4 float32"],
            1.0,
            Picture,
        ),
        row(
            [ORDER, JCGT17, FEWER],
            ["hamburger4 unorm16", "evsm2 float32"],
            1.0,
            Picture,
        ),
        row(
            [ORDER, I3D15, FEWER],
            ["hamburger4 unorm16", "vsm float32"],
            1.0,
            Picture,
        ),
        row(
            [ORDER, I3D15, FEWER],
            ["hamburger4 float16", "vsm float32"],
            1.0,
            Picture,
        ),
        row(
            [ORDER, I3D15, "four moments err less than one exponential"],
            ["hamburger4 unorm16", "esm float32"],
            1.0,
            Picture,
        ),
        row(
            [
                ORDER,
                I3D15_HAUSDORFF,
                "bounding depth as well gains too little to be worth its noise",
            ],
            ["hamburger4 unorm16", "hausdorff4 unorm16"],
            1.02,
            Picture,
        ),
        row(
            [ORDER, I3D16, "six moments err less than four"],
            ["hamburger6 float32", "hamburger4 float32"],
            1.0,
            Picture,
        ),
        row(
            [ORDER, I3D16, "six moments fit 10 bits each"],
            ["hamburger6 unorm10", "hamburger4 unorm16"],
            1.0,
            Picture,
        ),
        row(
            [ORDER, I3D16, "six moments fit 10 bits each"],
            ["hamburger6 unorm10", "hamburger6 unorm16"],
            1.1,
            Picture,
        ),
        row(
            [STORAGE, I3D15_STORAGE, AS_GOOD],
            ["hamburger4 unorm16", "hamburger4 float32"],
            1.1,
            Picture,
        ),
        row(
            [
                STORAGE,
                HPG17,
                "16 bits per moment leak noticeably more than 32",
            ],
            ["hamburger4 float32", "hamburger4 unorm16"],
            0.9,
            Leaking,
        ),
        row(
            [STORAGE, GI08, "layers do with 16 bits per channel"],
            ["lvsm unorm16", "lvsm float32"],
            1.05,
            Picture,
        ),
        row(
            [
                LEAKS,
                JCGT17,
                "four moments in 64 bits leak less than exponential variance",
            ],
            ["hamburger4 unorm16", "evsm4 float16"],
            1.0,
            Leaking,
        ),
        row(
            [
                LEAKS,
                JCGT17,
                "four moments in 128 bits leak less than exponential variance",
            ],
            ["hamburger4 float32", "evsm4 float32"],
            1.0,
            Leaking,
        ),
        row(
            [
                LEAKS,
                EXPONENTIAL,
                "exponential variance leaks less than variance",
            ],
            ["evsm4 float32", "vsm float32"],
            1.0,
            Leaking,
        ),
        row(
            [
                LEAKS,
                EXPONENTIAL,
                "exponential variance leaks less than layers of the same size",
            ],
            ["evsm4 float32", "lvsm unorm16"],
            1.0,
            Leaking,
        ),
        row(
            [LAYERS, LAYERED, UNBLED],
            ["lvsm unorm16", "vsm unorm16"],
            0.9,
            Leaking,
        ),
        row(
            [LAYERS, LAYERED, UNBLED],
            ["lvsm unorm16", "vsm unorm16"],
            0.9,
            Picture,
        ),
        row(
            [LAYERS, LAYERED, MEMORY],
            ["lvsm unorm16", "convolution unorm8"],
            1.0,
            Picture,
        ),
        row(
            [LAYERS, LAYERED, MEMORY],
            ["lvsm unorm16", "convolution unorm8"],
            1.0,
            Surfaces,
        ),
        row(
            [AIR, GDC16, SHAFTS],
            ["6 moments float16", "march 128"],
            1.25,
            Air,
        ),
        row(
            [AIR, GDC16, "two fetches take less time than 128 steps"],
            ["6 moments float16", "march 128"],
            1.0,
            AirTime,
        ),
        row(
            [AIR, JCGT17_AIR, "six moments err less than four"],
            ["6 moments float16", "4 moments float16"],
            1.0,
            Air,
        ),
        row(
            [AIR, GDC16, "10 bits per moment suffice"],
            ["6 moments unorm10", "6 moments float16"],
            1.1,
            Air,
        ),
        row(
            [
                AIR,
                GDC16,
                "64 bits of six moments are as good as 256 of a convolution map",
            ],
            ["6 moments unorm10", "convolution"],
            1.1,
            Air,
        ),
        row(
            [
                SOFT,
                JCGT17_SOFT,
                "moment soft shadows err no more than percentage-closer ones",
            ],
            ["moment soft", "pcss 9x9"],
            1.0,
            Soft,
        ),
        row(
            [SOFT, GDC16, "they take less time, whatever the picture"],
            ["moment soft", "pcss 9x9"],
            1.0,
            SoftTime,
        ),
        row(
            [
                TIME,
                I3D15_TIME,
                "four moments take less time than percentage-closer filtering",
            ],
            ["hamburger4 unorm16", "pcf, comparison samplers"],
            1.0,
            Time(All),
        ),
        row(
            [TIME, I3D15_TIME, "two moments take less time than four"],
            ["vsm unorm16", "hamburger4 unorm16"],
            1.0,
            Time(All),
        ),
        row(
            [
                TIME,
                GDC16,
                "where the map is large, percentage-closer filtering takes less",
            ],
            ["pcf, comparison samplers", "hamburger4 unorm16"],
            1.0,
            Time(LargestMap),
        ),
        row(
            [
                TIME,
                GDC16,
                "where the picture is large, four moments take less",
            ],
            ["hamburger4 unorm16", "pcf, comparison samplers"],
            1.0,
            Time(LargestPicture),
        ),
        row(
            [
                TIME,
                GDC16,
                "where the filter is wide, four moments take less",
            ],
            ["hamburger4 unorm16", "pcf, comparison samplers"],
            1.0,
            Time(WidestFilter),
        ),
        row(
            [
                TIME,
                VSM08,
                "with the filter's width percentage-closer filtering grows as its square, two moments in proportion",
            ],
            ["vsm unorm16", "pcf"],
            0.6,
            Growth,
        ),
        row(
            [
                TIME,
                LAYERED,
                "layers take less time than a convolution map of the same size",
            ],
            ["lvsm unorm16", "convolution unorm8"],
            1.0,
            Time(All),
        ),
    ]
};
