//! The vectors, which come from the processor, against the same functions on the adapter.

use moment_shadows::{Bits, MapEncoding, Storage, Target, Technique, Vectors};
use moment_shadows_lab::ports::{
    Compared, Runner, Shader, encodings, exported, name, vectors, wrapper,
};

fn compared(runner: &Runner, encoding: &MapEncoding, vectors: &Vectors) -> Compared {
    let text = wrapper(encoding, Target::Wgsl, vectors).unwrap();
    let given = runner.run(&Shader::Wgsl(&text), vectors).unwrap();
    Compared::new(name(encoding), Target::Wgsl, vectors, &given, &given)
}

#[test]
fn wgsl_gives_the_vectors_on_the_adapter() {
    let runner = Runner::open().unwrap();
    let mut rows = 0;
    for encoding in encodings() {
        let vectors = vectors(&encoding).unwrap();
        let compared = compared(&runner, &encoding, &vectors);
        println!("{compared}");
        let total = compared.total();
        assert_eq!(total.beyond, 0, "{compared}");
        rows += total.rows;
    }
    assert!(rows > 5000, "{rows}");
}

#[test]
fn a_port_that_is_wrong_is_found() {
    let runner = Runner::open().unwrap();
    let encoding = MapEncoding::new(Technique::Hamburger4, Storage::Float32).unwrap();
    let right = vectors(&encoding).unwrap();
    for (number, function) in right.functions.iter().enumerate() {
        let mut wrong = right.clone();
        let row = &mut wrong.functions[number].rows[5];
        let value = f32::from_bits(row.bits[0].0);
        row.bits[0] = Bits((value + 2.0 * row.tolerance[0] + 1e-3).to_bits());
        row.fused = None;
        let compared = compared(&runner, &encoding, &wrong);
        let beyond = compared
            .functions
            .iter()
            .filter(|(_, counts)| counts.beyond == 1);
        let beyond: Vec<_> = beyond.map(|(name, _)| name).collect();
        assert_eq!(beyond, [&function.name]);
    }
}

#[test]
fn vectors_are_read_as_they_are_written() {
    let encoding = MapEncoding::new(Technique::Hamburger6, Storage::Unorm10).unwrap();
    let vectors = vectors(&encoding).unwrap();
    let of_msl = exported(&encoding, Target::Msl).unwrap().vectors();
    assert_eq!(of_msl.unwrap(), vectors);
    let text = serde_json::to_string(&vectors).unwrap();
    assert_eq!(serde_json::from_str::<Vectors>(&text).unwrap(), vectors);
    let wrong = text.replacen("\"0x", "\"0y", 1);
    let error = serde_json::from_str::<Vectors>(&wrong).unwrap_err();
    assert!(error.to_string().contains("is not written as"), "{error}");
}
