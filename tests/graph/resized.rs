//! Imports of another size: what follows from them is in the plan, so that a host without the compiler can resize.

use moment_shadows::Profile;
use moment_shadows_graph::{Capabilities, Graph, NodeRegistry, Plan, PlannedWork, ResourceDesc};

use crate::hazards::plans_of;

/// The plan with imports of other sizes, made of nothing but the plan.
fn resized(plan: &Plan, sizes: &[[u32; 2]]) -> Plan {
    let mut plan = plan.clone();
    for resource in &mut plan.resources {
        let (Some(extent), ResourceDesc::Texture(texture)) = (resource.extent, &mut resource.desc)
        else {
            continue;
        };
        let size = sizes[extent.import];
        texture.size = [0, 1].map(|axis| size[axis].div_ceil(extent.per[axis]));
    }
    for memory in 0..plan.memory.len() {
        let home = moment_shadows_graph::Home::Memory(memory);
        let resident = plan.resources.iter().find(|it| it.home == home).unwrap();
        if let (ResourceDesc::Texture(to), Some(from)) =
            (&mut plan.memory[memory].desc, resident.desc.texture())
        {
            to.size = from.size;
        }
    }
    for pass in &mut plan.passes {
        if let PlannedWork::Compute {
            workgroups,
            covers,
            level,
            texels_per_workgroup,
            regions: None,
        } = &mut pass.work
        {
            let size = plan.resources[*covers]
                .desc
                .texture()
                .unwrap()
                .size_at(*level);
            *workgroups = [0, 1].map(|axis| size[axis].div_ceil(texels_per_workgroup[axis]));
        }
    }
    plan
}

/// What the sizes do not change: bytes are counted, tables know their map's extent, and limits follow.
fn without_counts(mut plan: Plan) -> Plan {
    for pass in &mut plan.passes {
        (pass.bytes_read, pass.bytes_written) = (0, 0);
    }
    for table in &mut plan.parameters.regions {
        table.extent = [0; 2];
    }
    plan.device.limits.clear();
    plan
}

#[test]
fn what_follows_from_imports_is_what_the_compiler_says() {
    let device = Capabilities::of_profile(Profile::NativeAdapter);
    let mut compared = 0;
    for (text, plan) in plans_of(&device) {
        let graph = Graph::parse(&text, &NodeRegistry::new()).unwrap();
        for sizes in [
            [[1000, 700], [333, 77]],
            [[1023, 1536], [1, 1]],
            [[320, 4096], [1920, 1080]],
        ] {
            let of_plan: Vec<_> = plan
                .imports
                .iter()
                .map(|import| match import.name.as_str() {
                    "light_depth" => sizes[0],
                    _ => sizes[1],
                })
                .collect();
            let imports: Vec<_> = plan
                .imports
                .iter()
                .zip(&of_plan)
                .map(|(import, &size)| {
                    let mut texture = plan.resources[import.value].desc.texture().unwrap().clone();
                    texture.size = size;
                    (import.name.as_str(), ResourceDesc::Texture(texture))
                })
                .collect();
            let mut compiled = graph.compile(&device, &imports).unwrap();
            let resized = resized(&plan, &of_plan);
            if compiled.passes.len() != resized.passes.len() {
                // As many mip levels as the size allows: the host's is fixed by the plan.
                assert!(text.contains("\"all\""));
                continue;
            }
            compiled = without_counts(compiled);
            assert_eq!(without_counts(resized), compiled, "{sizes:?} of {text}");
            compared += 1;
        }
    }
    assert!(compared > 80, "{compared}");
}
