//! `validate`: files and folders in order, own modules, features, and each form of the output.

use std::fs;

use moment_shadows::{Rule, ValidationReport};
use serde_json::Value;

use crate::{files, run};

const GOOD: &str = "import moment_shadows::maths::hankel::{hankel_factor};\nfn f() {}\n";
const BAD: &str = "import moment_shadows::maths::hankel::{hankel_faktor};\n";
/// Two faults in two functions.
const TWO: &str = "fn a() -> f32 { return 1u; }\nfn b(i: u32) -> u32 { return 1u << i | 1u; }\n";
const WARNED: &str = "diagnostic(warning, derivative_uniformity);\n\
    @fragment fn main(@location(0) x: f32) -> @location(0) vec4f {\n\
    if x > 0.5 { return vec4f(dpdx(x)); }\n\
    return vec4f(x); }\n";

#[test]
fn results_come_in_the_order_of_files() {
    let (_folder, [bad, good, norm]) = files([
        ("bad.wgsl", BAD),
        ("good.wgsl", GOOD),
        (
            "norm.wgsl",
            "@group(0) @binding(0) var target_: texture_storage_2d<rgba16unorm, write>;\n\
             @compute @workgroup_size(1) fn f() { textureStore(target_, vec2u(), vec4f()); }\n",
        ),
    ]);
    let (code, printed, said) = run(&["validate", &good]);
    assert_eq!((code, said.as_str()), (Some(0), ""));
    assert!(printed.starts_with(&format!("ok  {good}  ")), "{printed}");

    let (code, printed, said) = run(&["validate", &good, &bad, &good]);
    assert_eq!(code, Some(1));
    let order: Vec<usize> = printed.match_indices("ok  ").map(|(at, _)| at).collect();
    let fault = printed.find("error[import]: ").unwrap();
    assert!(order[0] < fault && fault < order[1], "{printed}");
    assert!(printed.contains("`hankel_factor`") && printed.contains(&format!("{bad}:1:")));
    assert!(said.starts_with("1 of 3 files"), "{said}");

    assert_eq!(run(&["validate", &norm]).0, Some(1));
    let native = run(&["validate", &norm, "--profile", "native"]);
    assert_eq!(native.0, Some(0), "{native:?}");
    // WebGL has no compute shaders.
    let backends = "  spirv hlsl msl glsl-450; not glsl-es-300: entry point `f`: ";
    assert!(native.1.contains(backends), "{native:?}");

    let quiet = run(&["validate", "--quiet", &good]);
    assert_eq!(quiet, (Some(0), String::new(), String::new()));
    let (code, printed, said) = run(&["validate", "--quiet", &good, &bad]);
    assert_eq!((code, said.as_str()), (Some(1), ""));
    assert!(printed.starts_with("error[import]: "), "{printed}");
}

#[test]
fn files_that_cannot_be_read_are_faults_beside_others() {
    let (folder, [good, long]) = files([
        ("good.wgsl", GOOD),
        (
            "long.wgsl",
            &" ".repeat(ValidationReport::LONGEST_SHADER + 1),
        ),
    ]);
    let binary = folder.path().join("binary.wgsl");
    fs::write(&binary, [0xff, 0xfe, 0x00]).unwrap();
    let (code, printed, _) = run(&[
        "validate",
        "missing.wgsl",
        &long,
        binary.to_str().unwrap(),
        &good,
    ]);
    assert_eq!(code, Some(1));
    assert_eq!(printed.matches("error[file]: ").count(), 3, "{printed}");
    for expected in [
        "'missing.wgsl' cannot be read",
        "it is longer than",
        "it is not UTF-8",
    ] {
        assert!(printed.contains(expected), "{printed}");
    }
    assert!(printed.contains(&format!("ok  {good}")), "{printed}");
}

#[test]
fn folders_stand_for_their_shaders() {
    let (folder, _) = files([
        ("shaders/b.wgsl", GOOD),
        ("shaders/a/sky.wgsl", TWO),
        ("shaders/a/wave.wesl", GOOD),
        ("shaders/readme.md", "none"),
    ]);
    fs::create_dir(folder.path().join("empty")).unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    let (code, printed, _) = run(&["validate", &path("shaders")]);
    assert_eq!(code, Some(1));
    assert_eq!(printed.matches("error[").count(), 2, "{printed}");
    assert!(
        printed.matches("ok  ").count() == 2 && printed.contains("sky.wgsl:1:24"),
        "{printed}"
    );
    let (code, _, said) = run(&["validate", &path("empty")]);
    assert_eq!(code, Some(1));
    assert!(said.contains("no file that ends in .wgsl"), "{said}");
}

#[test]
fn shaders_import_modules_of_their_own() {
    let (folder, [user, lights, _sun, broken]) = files([
        (
            "user.wgsl",
            "import my_engine::lights::{lit};\nimport my_engine::sky::sun::{SUN};\n\
             @fragment fn main() -> @location(0) vec4f { return vec4f(lit(SUN)); }\n",
        ),
        (
            "my_engine/lights.wgsl",
            "import moment_shadows::maths::hankel::{hankel_factor};\nfn lit(x: f32) -> f32 { return x; }\n",
        ),
        ("my_engine/sky/sun.wgsl", "const SUN = 1.0;\n"),
        (
            "broken/lights.wgsl",
            "fn lit(x: f32) -> f32 {\n    return y;\n}\n",
        ),
    ]);
    let path = |name: &str| folder.path().join(name).display().to_string();
    let (code, printed, _) = run(&["validate", &user, "--module", &path("my_engine")]);
    assert_eq!(code, Some(0), "{printed}");

    // One file is a module of its folder's name.
    let (code, printed, _) = run(&["validate", &user, "--module", &lights]);
    assert_eq!(code, Some(1));
    assert!(
        printed.contains("there is no module `my_engine::sky::sun`"),
        "{printed}"
    );
    let sun = format!("my_engine::sky::sun={}", path("my_engine/sky/sun.wgsl"));
    let named = format!("my_engine::lights={broken}");
    let (code, printed, _) = run(&["validate", &user, "--module", &named, "--module", &sun]);
    assert_eq!(code, Some(1));
    // The place is in the file.
    assert!(printed.contains(&format!("{broken}:2:12")), "{printed}");

    let twice = ["validate", &user, "--module", &lights, "--module", &lights];
    let (code, _, said) = run(&twice);
    assert_eq!(code, Some(1));
    assert!(said.contains("imported as `my_engine::lights`"), "{said}");
    let (code, printed, _) = run(&["validate", &user, "--module", &format!("super::x={lights}")]);
    assert_eq!(code, Some(1));
    assert!(
        printed.contains("`super::x` is no module's path"),
        "{printed}"
    );
}

#[test]
fn features_are_allowed_by_name() {
    let (_folder, [half, groups]) = files([
        (
            "half.wgsl",
            "enable f16;\nfn f(x: f16) -> f16 { return x * 2h; }\n",
        ),
        (
            "groups.wgsl",
            "@compute @workgroup_size(8) fn main() { _ = subgroupAdd(1u); }\n",
        ),
    ]);
    let (code, printed, _) = run(&["validate", &half, &groups]);
    assert_eq!(code, Some(1));
    assert_eq!(printed.matches("error[feature]: ").count(), 2, "{printed}");
    let (code, printed, _) = run(&["validate", &half, &groups, "--allow", "f16,subgroups"]);
    assert_eq!(code, Some(0), "{printed}");
    assert_eq!(
        run(&["validate", &half, "--allow", "shader_int64"]).0,
        Some(1)
    );
}

#[test]
fn json_holds_every_finding() {
    let (_folder, [good, two, warned]) = files([
        ("good.wgsl", GOOD),
        ("two.wgsl", TWO),
        ("warned.wgsl", WARNED),
    ]);
    let (code, printed, said) = run(&["validate", "--format", "json", &good, &two, &warned]);
    assert_eq!((code, said.as_str()), (Some(1), ""));
    let json: Value = serde_json::from_str(&printed).unwrap();
    assert_eq!(json["version"], 1);
    assert_eq!(json["profile"], "webgpu-core");
    let files = json["files"].as_array().unwrap();
    assert_eq!(files.len(), 3);
    assert_eq!(files[0]["valid"], true);
    assert_eq!(files[0]["backends"][0]["name"], "spirv");
    let rules: Vec<_> = files[1]["findings"].as_array().unwrap().iter().collect();
    assert_eq!(rules.len(), 2, "{printed}");
    assert_eq!(
        (&rules[0]["rule"], &rules[1]["rule"]),
        (&"wgsl".into(), &"operator".into())
    );
    assert_eq!(rules[1]["places"][0]["line"], 2);
    assert_eq!(files[2]["valid"], true);
    assert_eq!(files[2]["findings"][0]["severity"], "warning");
    assert_eq!(files[2]["findings"][0]["rule"], "uniformity");

    let (_, printed, _) = run(&["validate", "--format", "json", "--quiet", &good, &two]);
    let json: Value = serde_json::from_str(&printed).unwrap();
    assert_eq!(json["files"].as_array().unwrap().len(), 1);
}

#[test]
fn github_gets_annotations_with_file_and_line() {
    let (_folder, [two, warned, odd]) = files([
        ("two.wgsl", TWO),
        ("warned.wgsl", WARNED),
        ("a,b:c.wgsl", TWO),
    ]);
    let (code, printed, _) = run(&["validate", "--format", "github", &two, &warned, &odd]);
    assert_eq!(code, Some(1));
    let lines: Vec<&str> = printed.lines().collect();
    assert_eq!(lines.len(), 5, "{printed}");
    let start = format!("::error file={two},line=1,col=24,endColumn=26,title=shader%3A wgsl::");
    assert!(lines[0].starts_with(&start), "{printed}");
    assert!(
        lines[1].contains(",line=2,") && lines[1].contains("`<<` and `|`"),
        "{printed}"
    );
    assert!(
        lines[2].starts_with("::warning ") && lines[2].contains(",line=3,"),
        "{printed}"
    );
    assert!(lines[3].contains("a%2Cb%3Ac.wgsl,line=1"), "{printed}");
}

#[test]
fn sarif_says_what_a_related_place_is() {
    let (_folder, [twice]) = files([("twice.wgsl", "fn f() {}\nfn f() {}\n")]);
    let (_, printed, _) = run(&["validate", "--format", "sarif", &twice]);
    let sarif: Value = serde_json::from_str(&printed).unwrap();
    let related = &sarif["runs"][0]["results"][0]["relatedLocations"];
    assert_eq!(
        related[0]["physicalLocation"]["region"]["startLine"], 1,
        "{printed}"
    );
    let text = related[0]["message"]["text"].as_str().unwrap();
    assert!(text.contains("`f`"), "{text}");
    // Nothing is said of the place itself.
    let place = &sarif["runs"][0]["results"][0]["locations"][0];
    assert!(place["message"].is_null(), "{place}");
}

#[test]
fn sarif_has_a_result_for_each_finding() {
    let (_folder, [two, warned, odd]) = files([
        ("two.wgsl", TWO),
        ("warned.wgsl", WARNED),
        ("a b.wgsl", BAD),
    ]);
    let (code, printed, _) = run(&["validate", "--format", "sarif", &two, &warned, &odd]);
    assert_eq!(code, Some(1));
    let sarif: Value = serde_json::from_str(&printed).unwrap();
    assert_eq!(sarif["version"], "2.1.0");
    let run = &sarif["runs"][0];
    let rules = run["tool"]["driver"]["rules"].as_array().unwrap();
    assert_eq!(rules.len(), Rule::ALL.len());
    let results = run["results"].as_array().unwrap();
    let levels: Vec<_> = results
        .iter()
        .map(|it| it["level"].as_str().unwrap())
        .collect();
    assert_eq!(levels, ["error", "error", "warning", "error"]);
    for result in results {
        assert!(
            rules.iter().any(|rule| rule["id"] == result["ruleId"]),
            "{result}"
        );
        let place = &result["locations"][0]["physicalLocation"];
        assert!(
            place["region"]["startLine"].as_u64().unwrap() > 0,
            "{result}"
        );
    }
    let uri = &results[3]["locations"][0]["physicalLocation"]["artifactLocation"]["uri"];
    assert!(uri.as_str().unwrap().ends_with("/a%20b.wgsl"), "{uri}");
}

/// `./run check` fetches the schema.
#[test]
#[ignore = "the schema of SARIF is fetched by ./run check"]
fn sarif_by_its_schema() {
    let path = std::env::var("SARIF_SCHEMA").expect("the path of the schema");
    // A pattern of the schema has a bracket too many.
    let text = fs::read_to_string(path).unwrap();
    let text = text.replace("[a-zA-Z]{2}]?$", "[a-zA-Z]{2}$");
    let schema: Value = serde_json::from_str(&text).unwrap();
    let schema = jsonschema::validator_for(&schema).unwrap();
    let (_folder, [good, two, warned, odd]) = files([
        ("good.wgsl", GOOD),
        ("two.wgsl", TWO),
        ("warned.wgsl", WARNED),
        ("a b.wgsl", BAD),
    ]);
    let (_, printed, _) = run(&[
        "validate",
        "--format",
        "sarif",
        &good,
        &two,
        &warned,
        &odd,
        "missing.wgsl",
    ]);
    let mut sarif: Value = serde_json::from_str(&printed).unwrap();
    let errors: Vec<String> = schema
        .iter_errors(&sarif)
        .map(|it| it.to_string())
        .collect();
    assert!(errors.is_empty(), "{errors:#?}");
    // The schema sees what is wrong.
    sarif["runs"][0]["results"][0]["level"] = "fatal".into();
    assert!(schema.iter_errors(&sarif).next().is_some());
}
