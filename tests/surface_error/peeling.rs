//! Depth peeling against intersections of rays and triangles one by one, and on cases that can be worked out by hand.

use glam::{DVec2, DVec3};
use moment_shadows_lab::light::{DirectionalFit, LightView};
use moment_shadows_lab::scene::{Image, Material, Scene};
use moment_shadows_lab::truth::peel::{LightSurface, Peeler};
use wgpu::AddressMode;

use crate::setup::{Random, plate, scene, soup};

const DOWN: DVec3 = DVec3::NEG_Y;

/// A sun for a map that is not square, over the points of a scene.
fn sun(scene: &Scene, direction: DVec3, map: [u32; 2]) -> LightView {
    let casters: Vec<DVec3> = scene.casters().collect();
    LightView::directional_fitted(
        direction,
        &casters,
        DirectionalFit {
            map,
            margin: 0.0,
            reversed: false,
        },
    )
    .unwrap()
}

/// A spot light within the scene, so that triangles lie beside and behind it and cross its near plane.
fn spot() -> LightView {
    LightView::spot(
        DVec3::new(0.1, 0.3, -0.2),
        DVec3::new(0.3, -1.0, 0.4),
        1.9,
        0.05,
        None,
        [0.05, 3.0],
        false,
    )
    .unwrap()
}

/// Distance along the light's axis at which a ray meets a triangle, and by how much the nearest of its weights misses
/// 0: Cramer's rule, as by Möller and Trumbore.
fn intersection((origin, direction): (DVec3, DVec3), [a, b, c]: [DVec3; 3]) -> (f64, f64) {
    let (u, v, from) = (b - a, c - a, origin - a);
    let determinant = direction.cross(v).dot(u);
    let second = direction.cross(v).dot(from) / determinant;
    let third = from.cross(u).dot(direction) / determinant;
    let weights = [1.0 - second - third, second, third];
    let least = weights.into_iter().fold(f64::INFINITY, f64::min);
    (from.cross(u).dot(v) / determinant, least)
}

#[test]
fn every_surface_on_a_ray_is_found_once() {
    let mut random = Random(7);
    let mut corner = || [0, 1, 2].map(|_| (2.0 * random.next() - 1.0) as f32);
    let triangles: Vec<[[f32; 3]; 3]> = (0..60).map(|_| [corner(), corner(), corner()]).collect();
    let corners: Vec<[DVec3; 3]> = triangles
        .iter()
        .map(|triangle| triangle.map(|corner| DVec3::from_array(corner.map(f64::from))))
        .collect();
    let scene = scene(vec![soup(&triangles[..25]), soup(&triangles[25..])]);
    let map = [37, 22];
    let slanted = sun(&scene, DVec3::new(0.4, -1.0, 0.2), map);
    for (light, near) in [(slanted, 0.0), (spot(), 0.05)] {
        let peeler = Peeler::new(&scene, &light, map).unwrap();
        let surfaces = peeler.rows(0..map[1]);
        let mut found = surfaces.iter().peekable();
        let mut rays_in_doubt = 0;
        for y in 0..map[1] {
            for x in 0..map[0] {
                let at = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
                let ray = light.ray(at / DVec2::new(f64::from(map[0]), f64::from(map[1])));
                let hits = corners.iter().map(|&corners| intersection(ray, corners));
                let in_doubt = hits.clone().any(|(_, least)| least.abs() < 1e-9);
                rays_in_doubt += u32::from(in_doubt);
                let mut expected: Vec<f64> = hits
                    .filter(|&(distance, least)| least >= 0.0 && distance >= near)
                    .map(|(distance, _)| distance)
                    .collect();
                expected.sort_by(f64::total_cmp);
                let mut here: Vec<&LightSurface> = Vec::new();
                while let Some(surface) = found.next_if(|surface| surface.texel == [x, y]) {
                    here.push(surface);
                }
                if in_doubt {
                    continue;
                }
                assert_eq!(here.len(), expected.len(), "ray {x} {y}");
                for (layer, (surface, distance)) in here.iter().zip(expected).enumerate() {
                    assert_eq!(surface.layer as usize, layer);
                    // Two ways to solve three equations in f64, whose determinants may be a few hundred times smaller
                    // than their terms.
                    assert!((surface.distance - distance).abs() < 1e-11, "ray {x} {y}");
                    let met = ray.0 + distance * ray.1;
                    assert!((surface.position - met).length() < 1e-10, "ray {x} {y}");
                }
            }
        }
        assert!(found.next().is_none());
        assert!(surfaces.len() > 2000, "{}", surfaces.len());
        assert!(rays_in_doubt < 3, "{rays_in_doubt}");
        // In bands of rows it is the same list.
        let bands = [0..5, 5..6, 6..map[1] + 9].map(|rows| peeler.rows(rows));
        assert_eq!(bands.concat(), surfaces);
    }
}

#[test]
fn a_ray_through_an_edge_meets_one_of_its_triangles() {
    // A map of 16 texels over [-1, 1]: every vertex of a plate whose corners are texel centres, every diagonal and every
    // edge between its cells lies on rays.
    let map = [16, 16];
    let cells = 14;
    let place = |x: i32, z: i32| [x, 0, z].map(|at| at as f32);
    let at = |x: i32, z: i32| {
        let [x, y, z] = place(x, z);
        [(x + 0.5) / 8.0 - 1.0, y, (z + 0.5) / 8.0 - 1.0]
    };
    let mut triangles = Vec::new();
    for z in 0..cells {
        for x in 0..cells {
            let [a, b, c, d] = [at(x, z), at(x, z + 1), at(x + 1, z + 1), at(x + 1, z)];
            // The diagonals run either way.
            triangles.extend(if (x + z) % 2 == 0 {
                [[a, b, c], [a, c, d]]
            } else {
                [[a, b, d], [b, c, d]]
            });
        }
    }
    let frame = scene(vec![plate(1.0, 1.0), plate(1.0, -1.0)]);
    let light = sun(&frame, DOWN, map);
    let scene = scene(vec![soup(&triangles)]);
    let surfaces = Peeler::new(&scene, &light, map).unwrap().rows(0..map[1]);
    let mut on_ray = [[0; 16]; 16];
    for surface in &surfaces {
        on_ray[surface.texel[1] as usize][surface.texel[0] as usize] += 1;
    }
    // One of two opposite borders belongs to the plate, as with every rasteriser: 14 rays either way. The light is fitted
    // to a plate that ends where the map does, so the texels are where they were laid out.
    let covered = on_ray.as_flattened().iter().filter(|&&count| count == 1);
    assert_eq!(covered.count(), 14 * 14);
    assert_eq!(surfaces.len(), 14 * 14);
}

#[test]
fn coincident_surfaces_count_once_and_holes_not_at_all() {
    let map = [32, 32];
    let mut holed = plate(1.0, 1.0);
    holed.material = 1;
    // Left half opaque, right half a hole: two texels, which the linear filter blends between their centres.
    let image = Image {
        width: 2,
        height: 1,
        rgba: vec![255, 255, 255, 255, 255, 255, 255, 0],
    };
    let mut ground = plate(9.0, -1.0);
    ground.ground = true;
    let mut scene = scene(vec![holed, plate(1.0, 0.0), plate(1.0, 0.0), ground]);
    scene.materials.push(Material {
        texture: Some(0),
        mask: Some(0.5),
        ..Material::plain("holed", [1.0; 3])
    });
    scene.images.push(image);
    let light = sun(&scene, DOWN, map);
    let surfaces = Peeler::new(&scene, &light, map).unwrap().rows(0..map[1]);
    let on_ray = |texel: [u32; 2]| {
        surfaces
            .iter()
            .filter(move |surface| surface.texel == texel)
    };
    // The image is repeated: it is opaque to 3/4 of the way between the centres, and again from behind the right one.
    let half_alpha = surfaces.iter().filter(|surface| surface.position.y > 0.9);
    assert_eq!(half_alpha.count(), 32 * 32 / 2);
    for texel in [[0, 0], [16, 9], [31, 31]] {
        let heights: Vec<f64> = on_ray(texel)
            .map(|surface| surface.position.y.round())
            .filter(|&y| y < 0.5)
            .collect();
        assert_eq!(heights, [0.0, -1.0], "{texel:?}");
    }
    assert!(surfaces.iter().all(|surface| surface.faces_light));
    // Straight from above, nothing has a slope.
    assert!(
        surfaces
            .iter()
            .all(|surface| surface.distance_per_texel() < 1e-12)
    );
}

#[test]
fn beyond_its_edges_an_image_goes_on_as_its_material_says() {
    let map = [24, 24];
    // Three images long: from -1 to 2.
    let mut long = plate(1.0, 1.0);
    long.material = 1;
    long.uvs.iter_mut().for_each(|uv| uv[0] = 3.0 * uv[0] - 1.0);
    let mut scene = scene(vec![long]);
    // Left half opaque, right half a hole.
    scene.images.push(Image {
        width: 2,
        height: 1,
        rgba: vec![255, 255, 255, 255, 255, 255, 255, 0],
    });
    scene.materials.push(Material {
        texture: Some(0),
        mask: Some(0.5),
        ..Material::plain("holed", [1.0; 3])
    });
    for (wrap, expected) in [
        (AddressMode::Repeat, "####....####....####...."),
        (AddressMode::MirrorRepeat, "....########........####"),
        (AddressMode::ClampToEdge, "############............"),
    ] {
        scene.materials[1].wrap[0] = wrap;
        let light = sun(&scene, DOWN, map);
        let surfaces = Peeler::new(&scene, &light, map).unwrap().rows(0..map[1]);
        let mut counts = [0; 24];
        for surface in &surfaces {
            counts[(12.0 * (surface.position.x + 1.0)) as usize] += 1;
        }
        let opaque = counts.map(|count| if count == 24 { '#' } else { '.' });
        assert_eq!(String::from_iter(opaque), expected, "{wrap:?}");
        assert_eq!(surfaces.len(), 12 * 24, "{wrap:?}");
    }
}

#[test]
fn slopes_are_those_of_the_planes() {
    // A plane that falls by 1/2 per unit of x; the map's columns are 2/16 units wide.
    let [a, b, c, d] =
        [[-1.0f32, -1.0], [-1.0, 1.0], [1.0, 1.0], [1.0, -1.0]].map(|[x, z]| [x, -0.5 * x, z]);
    let scene = scene(vec![soup(&[[a, b, c], [a, c, d]])]);
    let light = sun(&scene, DOWN, [16, 64]);
    let surfaces = Peeler::new(&scene, &light, [16, 64]).unwrap().rows(0..64);
    assert_eq!(surfaces.len(), 16 * 64);
    for surface in surfaces {
        assert!((surface.distance_per_texel() - 0.5 * 2.0 / 16.0).abs() < 1e-12);
    }
}

#[test]
fn a_scene_that_breaks_its_promises_is_named() {
    let whole = scene(vec![plate(1.0, 0.0), plate(1.0, 1.0)]);
    let light = sun(&whole, DOWN, [8, 8]);
    let refused = |scene: &Scene, map| Peeler::new(scene, &light, map).err().unwrap().to_string();
    assert!(refused(&whole, [8, 0]).contains("8x0 texels is empty"));
    let mut broken = whole.clone();
    broken.meshes[1].indices[4] = 6;
    let error = refused(&broken, [8, 8]);
    assert!(
        error.contains("mesh 1 of scene 'test'") && error.contains("vertex 6 of 6"),
        "{error}"
    );
    let mut broken = whole.clone();
    broken.meshes[0].positions[2][1] = f32::NAN;
    let error = refused(&broken, [8, 8]);
    assert!(
        error.contains("mesh 0 of scene 'test' has vertex 2"),
        "{error}"
    );
    let mut broken = whole;
    broken.meshes[0].uvs.pop();
    assert!(refused(&broken, [8, 8]).contains("mesh 0 of scene"));
}
