//! Inputs of exported functions with what they give, bit for bit.

use core::fmt;

use naga::{Function, Handle, Module};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::evaluate::{Machine, Rounding, Rule, Value};
use super::inputs::{average, conversions, depths, fragment_depths, mixtures, reductions, words};
use super::translate::parse;
use crate::MapEncoding;

/// What proves a port of an exported file.
///
/// A port is right where each word of an output has the `bits`, or the `fused` ones, or differs from the `bits` as a number by at most the
/// `tolerance`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Vectors {
    /// The version of the library.
    pub version: String,
    /// The technique with its settings, and the storage.
    pub encoding: MapEncoding,
    /// What is in the fields of a row.
    pub description: String,
    /// The functions.
    pub functions: Vec<FunctionVectors>,
}

/// A function and what it gives.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FunctionVectors {
    /// Its name.
    pub name: String,
    /// Its parameters in WGSL, as `z: f32`.
    pub parameters: Vec<String>,
    /// The type of its value in WGSL.
    pub gives: String,
    /// Inputs, and what the function gives.
    pub rows: Vec<VectorRow>,
}

/// The words of a call, scalar by scalar in the order of parameters, members and elements.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct VectorRow {
    /// What is passed.
    pub inputs: Vec<Bits>,
    /// What is given where each product and each sum is rounded.
    pub bits: Vec<Bits>,
    /// What is given where `fma` is rounded once; left out where it is the same.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fused: Option<Vec<Bits>>,
    /// How far each may be off with the accuracy that WGSL asks of arithmetic.
    pub tolerance: Vec<f32>,
}

/// 32 bits, in files as `"0x3f800000"`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bits(pub u32);

impl fmt::Display for Bits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:#010x}", self.0)
    }
}

impl Serialize for Bits {
    fn serialize<S: Serializer>(&self, file: S) -> Result<S::Ok, S::Error> {
        file.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Bits {
    fn deserialize<D: Deserializer<'de>>(file: D) -> Result<Self, D::Error> {
        let text = String::deserialize(file)?;
        let digits = text.strip_prefix("0x").filter(|it| it.len() == 8);
        let bits = digits.and_then(|it| u32::from_str_radix(it, 16).ok());
        bits.map(Bits).ok_or_else(|| {
            Error::custom(format_args!("'{text}' is not written as \"0x3f800000\" is"))
        })
    }
}

const DESCRIPTION: &str = "Words are scalars in the order of parameters, members and elements. A port gives the bits, or the fused \
    ones, or numbers that differ from the bits by at most the tolerance.";

/// Runs with arithmetic at random, from which tolerances come.
const RUNS: u64 = 48;

/// How much farther than in these runs a result may be off.
const MARGIN: f32 = 2.0;

/// The vectors of the functions that every file has.
pub(super) fn vectors(encoding: &MapEncoding, wgsl: &str) -> Result<Vectors, String> {
    let module = parse(wgsl)?;
    let source = Source {
        encoding,
        module: &module,
    };
    let functions = source.functions();
    Ok(Vectors {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        encoding: encoding.clone(),
        description: DESCRIPTION.to_owned(),
        functions: functions.ok_or("a function uses what is not evaluated")?,
    })
}

struct Source<'a> {
    encoding: &'a MapEncoding,
    module: &'a Module,
}

impl Source<'_> {
    fn functions(&self) -> Option<Vec<FunctionVectors>> {
        let depths = depths();
        let row = self.encoding.technique().row();
        let planes = if row.encodes_planes() { row.planes } else { 1 };
        let mut channels = Vec::new();
        let mut texels = Vec::new();
        for plane in 0..planes {
            channels.extend(depths.iter().map(|z| [words([*z]), vec![plane]].concat()));
            for mixture in mixtures() {
                let mean = self.mean(&mixture, plane)?;
                texels.push([words(mean), vec![plane]].concat());
            }
        }
        let texel = |inputs: &Vec<u32>| self.values("encoding_texel", inputs);
        let stored: Vec<Vec<u32>> = texels.iter().map(texel).collect::<Option<_>>()?;
        let values = stored.iter().map(|it| self.values("filtering_value", it));
        let values: Vec<Vec<u32>> = values.collect::<Option<_>>()?;
        // Averages of two; at the seams of planes they are of no use, and no harm.
        let averages = values.iter().zip(values.iter().skip(1));
        let averages: Vec<Vec<u32>> = averages.map(|(a, b)| average(a, b)).collect();
        let mut lit = Vec::new();
        let whole = self.lookups()?;
        for (index, value) in whole.iter().enumerate() {
            for depth in fragment_depths(index) {
                lit.push([value.clone(), words([depth])].concat());
            }
        }
        Some(vec![
            self.vectors("encoding_channels", &channels)?,
            self.vectors("encoding_texel", &texels)?,
            self.vectors("filtering_value", &stored)?,
            self.vectors("filtering_texel", &averages)?,
            self.vectors("technique_shadow_intensity", &lit)?,
            self.vectors("depth_to_moment_depth", &conversions())?,
            self.vectors("leak_reduction_apply", &reductions())?,
        ])
    }

    /// The mean of what is encoded for the depths of a mixture.
    fn mean(&self, mixture: &[f32], plane: u32) -> Option<Vec<f32>> {
        let mut sum = vec![0.0_f64; 4];
        for z in mixture {
            let channels =
                self.values("encoding_channels", &[words([*z]), vec![plane]].concat())?;
            for (sum, bits) in sum.iter_mut().zip(channels) {
                *sum += f64::from(f32::from_bits(bits)) / mixture.len() as f64;
            }
        }
        Some(sum.into_iter().map(|it| it as f32).collect())
    }

    /// What lookups give: filtered maps of the mixtures, and a map that casts no shadow.
    fn lookups(&self) -> Option<Vec<Vec<u32>>> {
        let planes = self.encoding.technique().row().planes;
        let mut all = Vec::new();
        for mixture in mixtures() {
            let mut value = Vec::new();
            for plane in 0..planes {
                let mean = [words(self.mean(&mixture, plane)?), vec![plane]].concat();
                let texel = self.values("encoding_texel", &mean)?;
                value.extend(self.values("filtering_value", &texel)?);
            }
            all.push(value);
        }
        let row = self.encoding.technique().row();
        let mut far = Vec::new();
        for texel in row.far_texels(self.encoding.storage())? {
            let texel = words(texel.iter().map(|it| *it as f32));
            far.extend(self.values("filtering_value", &texel)?);
        }
        all.push(far);
        Some(all)
    }

    fn function(&self, name: &str) -> Option<(Handle<Function>, &Function)> {
        let mut functions = self.module.functions.iter();
        functions.find(|(_, it)| it.name.as_deref() == Some(name))
    }

    /// What a function gives where each step is rounded. Words beyond its parameters are not read.
    fn values(&self, name: &str, inputs: &[u32]) -> Option<Vec<u32>> {
        self.run(name, inputs, Rounding::new(Rule::Separate, 0))
    }

    fn run(&self, name: &str, inputs: &[u32], rounding: Rounding) -> Option<Vec<u32>> {
        let (handle, function) = self.function(name)?;
        let mut bits = inputs.iter().copied();
        let arguments = function.arguments.iter();
        let arguments = arguments.map(|it| Value::read(self.module, it.ty, &mut bits));
        let arguments: Vec<Value> = arguments.collect::<Option<_>>()?;
        let value = Machine::new(self.module, rounding).call(handle, &arguments)?;
        let mut words = Vec::new();
        value.write(&mut words);
        Some(words)
    }

    fn vectors(&self, name: &str, inputs: &[Vec<u32>]) -> Option<FunctionVectors> {
        let (_, function) = self.function(name)?;
        let ty = |ty| type_name(self.module, ty);
        let parameters = function.arguments.iter();
        let parameters = parameters
            .map(|it| format!("{}: {}", it.name.as_deref().unwrap_or_default(), ty(it.ty)));
        let parameters: Vec<String> = parameters.collect();
        let mut rows: Vec<VectorRow> = Vec::new();
        for (seed, inputs) in inputs.iter().enumerate() {
            let row = self.row(name, inputs, seed as u64)?;
            if !rows.iter().any(|other| other.inputs == row.inputs) {
                rows.push(row);
            }
        }
        Some(FunctionVectors {
            name: name.to_owned(),
            parameters,
            gives: ty(function.result.as_ref()?.ty),
            rows,
        })
    }

    fn row(&self, name: &str, inputs: &[u32], seed: u64) -> Option<VectorRow> {
        let (_, function) = self.function(name)?;
        // Words beyond the parameters are left out.
        let mut read = Vec::new();
        let mut bits = inputs.iter().copied();
        for argument in &function.arguments {
            Value::read(self.module, argument.ty, &mut bits)?.write(&mut read);
        }
        let bits = self.values(name, &read)?;
        let fused = self.run(name, &read, Rounding::new(Rule::Fused, 0))?;
        // What is below the normal numbers may count as zero.
        let values = bits.iter().map(|it| f32::from_bits(*it));
        let tolerance = values.map(|it| if it.is_subnormal() { it.abs() } else { 0.0 });
        let mut tolerance: Vec<f32> = tolerance.collect();
        let mut widen = |other: &[u32]| {
            for ((tolerance, a), b) in tolerance.iter_mut().zip(&bits).zip(other) {
                let distance = (f32::from_bits(*a) - f32::from_bits(*b)).abs();
                *tolerance = tolerance.max(MARGIN * distance);
            }
        };
        widen(&fused);
        for run in 0..RUNS {
            widen(&self.run(
                name,
                &read,
                Rounding::new(Rule::Allowed, seed * RUNS + run + 1),
            )?);
        }
        let as_bits = |words: &[u32]| words.iter().map(|it| Bits(*it)).collect::<Vec<_>>();
        Some(VectorRow {
            inputs: as_bits(&read),
            fused: (fused != bits).then(|| as_bits(&fused)),
            bits: as_bits(&bits),
            tolerance,
        })
    }
}

/// A type in WGSL.
fn type_name(module: &Module, ty: Handle<naga::Type>) -> String {
    let ty = &module.types[ty];
    match (&ty.name, &ty.inner) {
        (Some(name), _) => name.clone(),
        (None, naga::TypeInner::Scalar(scalar)) => scalar_name(*scalar).to_owned(),
        (None, naga::TypeInner::Vector { size, scalar }) => {
            format!("vec{}<{}>", *size as u8, scalar_name(*scalar))
        }
        (
            None,
            naga::TypeInner::Array {
                base,
                size: naga::ArraySize::Constant(count),
                ..
            },
        ) => {
            format!("array<{}, {count}>", type_name(module, *base))
        }
        (None, other) => format!("{other:?}"),
    }
}

fn scalar_name(scalar: naga::Scalar) -> &'static str {
    match scalar.kind {
        naga::ScalarKind::Float => "f32",
        naga::ScalarKind::Uint => "u32",
        naga::ScalarKind::Sint => "i32",
        _ => "bool",
    }
}
