//! Drawings and scenes for other programs, read back by plain readers that share nothing with their writers.

use std::collections::BTreeMap;

use sightline::adjust::adjust;
use sightline::adjustment::{AdjustOptions, Adjustment};
use sightline::noise::Noise;
use sightline::project::{DrawnLine, Feature, FeatureKind, Layer, Project};
use sightline_exchange::export;

use crate::support::networks::{Wanted, exact, noisy};

fn result() -> (Project, Adjustment) {
    let mut project = noisy(&exact(&Wanted::default(), 3), &mut Noise::new(3, 0));
    // Far from 0, where single precision alone would lose the tenths.
    project.points[3].id = "점 \"7\"".into();
    for o in project.observations.iter_mut().filter(|o| o.point == "p3") {
        o.point = "점 \"7\"".into();
    }
    let line = |from: &str, to: &str, layer: &str| DrawnLine { from: from.into(), to: to.into(), layer: layer.into() };
    project.lines = vec![line("p0", "p1", "모서리"), line("p1", "p2", "edge/2"), line("p0", "p2", "")];
    project.layers =
        vec![Layer { id: "모서리".into(), colour: [255, 0, 0] }, Layer { id: "edge/2".into(), colour: [0, 0, 250] }];
    let points = (0..3).map(|k| format!("p{k}")).chain((4..10).map(|k| format!("p{k}"))).collect();
    let plane = FeatureKind::Plane { points: (4..12).map(|k| format!("p{k}")).collect() };
    project.features = vec![
        Feature { id: "ball".into(), kind: FeatureKind::Sphere { points } },
        Feature { id: "wall".into(), kind: plane },
    ];
    let adjustment = adjust(&project, &AdjustOptions::default(), &mut |_| true).expect("solvable");
    (project, adjustment)
}

fn text(format: &str, name: &str) -> String {
    let (project, adjustment) = result();
    let mut files = export(format, &project, Some(&adjustment)).expect("written");
    String::from_utf8(files.remove(name).expect(name)).expect("text")
}

/// Entities of a drawing: kind, and values by group code.
fn entities(text: &str) -> Vec<(String, BTreeMap<i32, String>)> {
    let lines: Vec<&str> = text.lines().collect();
    assert!(lines.len().is_multiple_of(2), "codes and values alternate");
    let mut all: Vec<(String, BTreeMap<i32, String>)> = Vec::new();
    for pair in lines.chunks_exact(2) {
        let code: i32 = pair[0].trim().parse().expect("a group code");
        if code == 0 {
            all.push((pair[1].to_owned(), BTreeMap::new()));
        } else if let Some((_, values)) = all.last_mut() {
            values.insert(code, pair[1].to_owned());
        }
    }
    all
}

#[test]
fn a_drawing_has_points_names_lines_layers_and_cameras() {
    let (project, adjustment) = result();
    let text = text("dxf", "drawing.dxf");
    assert!(text.is_ascii());
    let all = entities(&text);
    let of = |kind: &str| all.iter().filter(|(k, _)| k == kind).map(|(_, v)| v).collect::<Vec<_>>();
    let number = |v: &BTreeMap<i32, String>, code: i32| v[&code].parse::<f64>().expect("a number");
    let points = of("POINT");
    assert_eq!(points.len(), adjustment.points.len());
    for (drawn, found) in points.iter().zip(&adjustment.points) {
        let at = [number(drawn, 10), number(drawn, 20), number(drawn, 30)];
        assert_eq!(at, found.xyz);
    }
    let names: Vec<_> = of("TEXT").into_iter().filter(|v| v[&8] == "NAMES").map(|v| v[&1].clone()).collect();
    assert!(names.contains(&"p5".to_owned()) && names.contains(&"\\U+C810 \"7\"".to_owned()), "{names:?}");
    let layers: BTreeMap<_, _> = of("LAYER").into_iter().map(|v| (v[&2].clone(), v[&62].clone())).collect();
    for entity in all.iter().filter(|(k, _)| matches!(k.as_str(), "POINT" | "LINE" | "TEXT")) {
        assert!(layers.contains_key(&entity.1[&8]), "{entity:?} lies in a layer that is not there");
    }
    assert!(layers.keys().all(|l| l.len() <= 31 && l.chars().all(|c| c.is_ascii_alphanumeric() || "$-_".contains(c))));
    // Pure red and blue by their numbers, as every program has them.
    assert_eq!((layers["___"].as_str(), layers["EDGE_2"].as_str()), ("10", "170"));
    let lines = of("LINE");
    assert_eq!(lines.iter().filter(|v| ["___", "EDGE_2", "LINES"].contains(&v[&8].as_str())).count(), 3);
    assert_eq!(lines.iter().filter(|v| v[&8] == "CAMERAS").count(), 8 * project.photos.len());
    let radius = adjustment.features[0].value.expect("a diameter") / 2.0;
    let centre = adjustment.features[0].position.expect("a centre");
    let rings: Vec<_> = lines.iter().filter(|v| v[&8] == "FEATURES").collect();
    let (ball, wall) = rings.split_at(3 * 72);
    for v in ball {
        let d: f64 = (0..3).map(|k| (number(v, 10 * (k as i32 + 1)) - centre[k]).powi(2)).sum();
        assert!((d.sqrt() / radius - 1.0).abs() < 1e-9);
    }
    // The plane's edge: closed, and in the plane.
    let plane = &adjustment.features[1];
    let (foot, normal) = (plane.position.expect("a foot"), plane.direction.expect("a normal"));
    assert!(wall.len() >= 3);
    for (k, v) in wall.iter().enumerate() {
        let off: f64 = (0..3).map(|a| (number(v, 10 * (a as i32 + 1)) - foot[a]) * normal[a]).sum();
        assert!(off.abs() < 1e-6, "{off}");
        assert_eq!([11, 21, 31].map(|c| &v[&c]), [10, 20, 30].map(|c| &wall[(k + 1) % wall.len()][&c]));
    }
    assert_eq!(all.last().expect("an end").0, "EOF");
}

#[test]
fn polygon_files_say_how_much_they_hold() {
    let (_, adjustment) = result();
    for (name, vertices, others) in [
        ("points.ply", adjustment.points.len(), 0),
        ("ellipsoids.ply", 66 * adjustment.points.len(), 128 * adjustment.points.len()),
        ("cameras.ply", 5 * adjustment.photos.len(), 8 * adjustment.photos.len()),
    ] {
        let text = text("ply", name);
        let (head, body) = text.split_once("end_header\n").expect("a header");
        assert!(head.starts_with("ply\nformat ascii 1.0\n"), "{head}");
        let count = |element: &str| {
            let line = head.lines().find_map(|l| l.strip_prefix(&format!("element {element} ")));
            line.map_or(0, |n| n.parse::<usize>().expect("a count"))
        };
        assert_eq!((count("vertex"), count("face") + count("edge")), (vertices, others), "{name}");
        let rows: Vec<Vec<f64>> =
            body.lines().map(|l| l.split(' ').map(|n| n.parse().expect("a number")).collect()).collect();
        assert_eq!(rows.len(), vertices + others, "{name}");
        let first = usize::from(name == "ellipsoids.ply");
        for row in &rows[vertices..] {
            assert!(row[first..].iter().all(|k| (*k as usize) < vertices), "{name}: {row:?}");
        }
    }
    let rows = text("ply", "points.ply");
    let row = rows.lines().nth_back(adjustment.points.len() - 1).expect("a row").to_owned();
    let [x, _, z] = adjustment.points[0].xyz;
    assert!(row.starts_with(&format!("{x} ")) && row.split(' ').nth(2) == Some(&z.to_string()), "{row}");
    // On the ellipsoid of its point, times what the file says: xᵀΣ⁻¹x = factor².
    let text = text("ply", "ellipsoids.ply");
    let factor: f64 =
        text.split("1 sigma, ").nth(1).and_then(|t| t.split(' ').next()).expect("told").parse().expect("f");
    let body: Vec<&str> = text.split_once("end_header\n").expect("a header").1.lines().collect();
    let point = &adjustment.points[5];
    let [xx, xy, xz, yy, yz, zz] = point.covariance.expect("stated");
    let inverse = nalgebra::Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz).try_inverse().expect("regular");
    for line in &body[66 * 5..66 * 6] {
        let at: Vec<f64> = line.split(' ').map(|n| n.parse().expect("a number")).collect();
        let d = nalgebra::Vector3::from_fn(|k, _| at[k] - point.xyz[k]);
        assert!(((d.transpose() * inverse * d)[0].sqrt() / factor - 1.0).abs() < 1e-6);
    }
}

#[test]
fn a_scene_is_a_sound_binary_gltf() {
    let (project, adjustment) = result();
    let files = export("gltf", &project, Some(&adjustment)).expect("written");
    let bytes = &files["scene.glb"];
    let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().expect("four")) as usize;
    assert_eq!((&bytes[..4], word(4), word(8)), (&b"glTF"[..], 2, bytes.len()));
    let length = word(12);
    assert_eq!(&bytes[16..20], b"JSON");
    let json: serde_json::Value = serde_json::from_slice(&bytes[20..20 + length]).expect("json");
    assert_eq!(&bytes[24 + length..28 + length], b"BIN\0");
    let data = &bytes[28 + length..];
    assert_eq!(
        (data.len(), json["buffers"][0]["byteLength"].as_u64().expect("n") as usize),
        (word(20 + length), data.len())
    );
    let number = |v: &serde_json::Value| v.as_u64().expect("a number") as usize;
    for accessor in json["accessors"].as_array().expect("accessors") {
        let view = &json["bufferViews"][number(&accessor["bufferView"])];
        let size = match (number(&accessor["componentType"]), accessor["type"].as_str().expect("a type")) {
            (5126, "VEC3") => 12,
            (5125, "SCALAR") | (5121, "VEC4") => 4,
            other => panic!("{other:?}"),
        };
        assert_eq!(number(&accessor["count"]) * size, number(&view["byteLength"]));
        assert!(number(&view["byteOffset"]) + number(&view["byteLength"]) <= data.len());
        assert!(number(&view["byteOffset"]).is_multiple_of(4));
    }
    // The first mesh are the points about their middle, which the node above places.
    let middle = json["nodes"].as_array().expect("nodes").iter().find(|n| n["name"] == "object").expect("a middle");
    let shift: Vec<f64> = (0..3).map(|k| middle["translation"][k].as_f64().expect("a place")).collect();
    let positions = &json["meshes"][0]["primitives"][0]["attributes"]["POSITION"];
    let offset =
        number(&json["bufferViews"][number(&json["accessors"][number(positions)]["bufferView"])]["byteOffset"]);
    for (k, point) in adjustment.points.iter().enumerate() {
        for axis in 0..3 {
            let at = offset + 12 * k + 4 * axis;
            let value = f32::from_le_bytes(data[at..at + 4].try_into().expect("four"));
            assert!((f64::from(value) + shift[axis] - point.xyz[axis]).abs() < 1e-4, "{}", point.id);
        }
    }
    // Every corner of the sphere's surface is on the sphere.
    let ball = &adjustment.features[0];
    let surface = json["meshes"].as_array().expect("meshes").iter().find(|m| m["name"] == "feature ball surface");
    let primitive = &surface.expect("a surface")["primitives"][0];
    assert_eq!(json["materials"][number(&primitive["material"])]["alphaMode"], "BLEND");
    let accessor = &json["accessors"][number(&primitive["attributes"]["POSITION"])];
    let offset = number(&json["bufferViews"][number(&accessor["bufferView"])]["byteOffset"]);
    let (centre, radius) = (ball.position.expect("a centre"), ball.value.expect("a diameter") / 2.0);
    assert!(number(&accessor["count"]) > 1000);
    for k in 0..number(&accessor["count"]) {
        let squares = (0..3).map(|axis| {
            let at = offset + 12 * k + 4 * axis;
            let value = f32::from_le_bytes(data[at..at + 4].try_into().expect("four"));
            (f64::from(value) + shift[axis] - centre[axis]).powi(2)
        });
        assert!((squares.sum::<f64>().sqrt() / radius - 1.0).abs() < 1e-4);
    }
    let names: Vec<&str> =
        json["nodes"].as_array().expect("nodes").iter().map(|n| n["name"].as_str().expect("a name")).collect();
    for part in ["points", "ellipsoids", "cameras", "lines", "lines 모서리", "Sightline"] {
        assert!(names.contains(&part), "{names:?}");
    }
    let empty = export("gltf", &Project::default(), None).expect("written");
    assert!(empty["scene.glb"].starts_with(b"glTF"));
}
