//! Displacements between epochs as files: a table of all pairs (CSV), one pair as a drawing (DXF of release 12) or as a scene of arrows (glTF),
//! all of it as JSON.
//!
//! Units are in the headings; an empty field is a missing value. In the drawing a displacement d at the place x is a line from x
//! to x + factor·d on the layer of its judgement, the ends are points, and names stand on a layer of their own; a comment says
//! unit and factor. Coordinates are those of the earlier epoch in the system of the first.

use std::fmt::Write;

use super::arrows;
use super::dxf::{LayerNames, ascii, entity, header, label, pair as group};
use super::text::{disarmed, quoted};
use sightline::axes::ShownAxes;
use sightline::depiction::extent;
use sightline::error::{Error, Place, Reason, Result, Thing, shortened};
use sightline::monitoring::{Displacement, Monitoring, Pair, PointRole};

/// Writes a file: `csv`, `json`, or `dxf` and `gltf` of the pair of this number with displacements `factor` times as long.
///
/// # Errors
/// [`Error::Unknown`] for another format or pair, [`Error::Invalid`] for a factor that is not positive.
pub fn write(found: &Monitoring, format: &str, pair: usize, factor: f64) -> Result<Vec<u8>> {
    match format {
        "csv" => Ok(csv(found).into_bytes()),
        "json" => serde_json::to_vec_pretty(found).map_err(|error| {
            let reason = Reason::NotJson { message: error.to_string() };
            Error::Invalid { reason, at: Place::default() }
        }),
        "dxf" | "gltf" => {
            let unknown = || Error::Unknown { kind: Thing::Epoch, name: pair.to_string(), at: Place::field("pair") };
            let pair = found.pairs.get(pair).ok_or_else(unknown)?;
            if !(factor > 0.0 && factor < 1e12) {
                let reason = Reason::NotPositive { name: "factor".into(), value: factor.into() };
                return Err(Error::Invalid { reason, at: Place::field("factor") });
            }
            Ok(if format == "dxf" { dxf(found, pair, factor).into_bytes() } else { arrows::write(found, pair, factor) })
        }
        _ => Err(Error::Unknown { kind: Thing::Format, name: shortened(format), at: Place::field("format") }),
    }
}

/// Result for a point, as one word.
pub fn judgement(pair: &Pair, point: &Displacement) -> &'static str {
    match (point.role, pair.unstable.contains(&point.id)) {
        (PointRole::Reference, _) => "reference",
        (PointRole::Object, true) => "unstable_reference",
        (PointRole::Object, false) if point.test.is_none() => "not_tested",
        (PointRole::Object, false) if point.moved => "moved",
        (PointRole::Object, false) => "not_significant",
    }
}

/// Colour of a judgement.
pub fn colour(judgement: &str) -> [u8; 3] {
    match judgement {
        "moved" => [178, 78, 8],
        "unstable_reference" => [179, 18, 60],
        "reference" => [27, 108, 56],
        "not_tested" => [128; 3],
        _ => [11, 95, 168],
    }
}

fn csv(found: &Monitoring) -> String {
    let unit = found.unit.as_ref().map(|unit| format!(" [{unit}]")).unwrap_or_default();
    let axes = ShownAxes::of(found.axes);
    let triples = ["", "d", "s"].map(|prefix| axes.names().map(|name| format!("{prefix}{name}{unit}"))).concat();
    let lengths: Vec<String> =
        triples.into_iter().chain(["length", "s_length"].map(|name| format!("{name}{unit}"))).collect();
    let mut text = format!("from,to,id,later_id,{},T,f1,f2,limit,p,judgement,detectable{unit}\n", lengths.join(","));
    let value = |value: Option<f64>| value.map(|v| v.to_string()).unwrap_or_default();
    for pair in &found.pairs {
        for point in &pair.points {
            let words = [&pair.from, &pair.to, &point.id, point.later_id.as_ref().unwrap_or(&point.id)];
            let words = words.map(|word| quoted(&disarmed(word), ',').into_owned());
            let numbers = [point.xyz, point.difference, point.sigma]
                .map(|triple| axes.shown(triple))
                .concat()
                .into_iter()
                .map(Some);
            let numbers = numbers.chain([Some(point.length), point.length_sigma]);
            let test = point.test.as_ref();
            let tested = [
                test.map(|t| t.statistic),
                test.map(|t| t.f1),
                test.and_then(|t| t.f2),
                test.map(|t| t.limit),
                test.map(|t| t.p),
            ];
            let numbers: Vec<String> = numbers.chain(tested).map(value).collect();
            let detectable = value(point.detectable.map(|d| d.worst));
            // Writing into a string does not fail.
            let _ = writeln!(text, "{},{},{},{detectable}", words.join(","), numbers.join(","), judgement(pair, point));
        }
    }
    text
}

fn dxf(found: &Monitoring, pair: &Pair, factor: f64) -> String {
    let (centre, size) = extent(pair.points.iter().map(|p| p.xyz));
    let height = 0.008 * size;
    let mut layers = LayerNames::default();
    let mut body = String::new();
    for point in &pair.points {
        let judgement = judgement(pair, point);
        let colour = colour(judgement);
        let name = match judgement {
            "moved" => "MOVED",
            "unstable_reference" => "REFERENCE_UNSTABLE",
            "reference" => "REFERENCE_STABLE",
            "not_tested" => "NOT_TESTED",
            _ => "NOT_SIGNIFICANT",
        };
        let tip = std::array::from_fn(|k| point.xyz[k] + factor * point.difference[k]);
        let places = layers.named(&format!("POINTS_{name}"), colour);
        entity(&mut body, "POINT", &places, &[(10, point.xyz)]);
        let vectors = layers.named(&format!("VECTORS_{name}"), colour);
        entity(&mut body, "LINE", &vectors, &[(10, point.xyz), (11, tip)]);
        let names = layers.named("NAMES", [128; 3]);
        let beside = std::array::from_fn(|k| point.xyz[k] + if k < 2 { height / 2.0 } else { 0.0 });
        label(&mut body, &names, beside, height, &point.id);
    }
    let unit = found.unit.as_deref().unwrap_or("-");
    let mut text = String::new();
    let title = format!("Sightline, {} to {}, unit {unit}, displacements x {factor}", pair.from, pair.to);
    group(&mut text, 999, &ascii(&title));
    header(&mut text, centre, size);
    layers.table(&mut text);
    text.push_str("0\nSECTION\n2\nENTITIES\n");
    text.push_str(&body);
    text.push_str("0\nENDSEC\n0\nEOF\n");
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use sightline::monitoring::{Epoch, ListedPoint, Options, compare_epochs};
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    fn found() -> Monitoring {
        let epoch = |name: &str, by: f64| {
            let at = |k: usize| [(k % 3) as f64 * 100.0, (k / 3) as f64 * 90.0, (k * k % 5) as f64 * 20.0];
            let point = |k: usize| {
                let [x, y, z] = at(k);
                let z = if k == 8 { z + by } else { z };
                ListedPoint { id: format!("p,{k}"), xyz: [x, y, z], sigma: Some([0.1; 3]) }
            };
            Epoch {
                name: name.into(),
                points: Some((0..9).map(point).collect()),
                unit: Some("mm".into()),
                ..Epoch::default()
            }
        };
        let reference = Some((0..8).map(|k| format!("p,{k}")).collect());
        compare_epochs(&[epoch("a", 0.0), epoch("=b", 5.0)], &Options { reference, ..Options::default() })
            .expect("found")
    }

    #[test]
    fn a_table_has_a_row_of_each_point_and_as_many_fields_as_its_heading() {
        let text = csv(&found());
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines.len(), 10);
        assert!(lines[0].contains("dZ [mm]") && !text.contains(",=b"));
        let moved = lines.iter().find(|line| line.contains("\"p,8\"")).expect("the moved point");
        assert!(moved.contains(",moved,"), "{moved}");
        assert_eq!(moved.replace("\"p,8\"", "p8").split(',').count(), lines[0].split(',').count());
    }

    #[test]
    fn a_drawing_has_a_vector_of_each_point_on_the_layer_of_its_judgement() {
        let found = found();
        let text = String::from_utf8(write(&found, "dxf", 0, 100.0).expect("a drawing")).expect("text");
        assert_eq!(text.matches("\nLINE\n").count(), 9);
        assert!(text.contains("VECTORS_MOVED") && text.contains("VECTORS_REFERENCE_STABLE") && text.contains("x 100"));
        let tip = found.pairs[0].points[8].xyz[2] + 100.0 * found.pairs[0].points[8].difference[2];
        assert!(text.contains(&format!("31\n{tip}")), "{tip}");
        assert!(write(&found, "dxf", 1, 1.0).is_err() && write(&found, "dxf", 0, 0.0).is_err());
        assert!(write(&found, "obj", 0, 1.0).is_err());
        let again: Monitoring =
            serde_json::from_slice(&write(&found, "json", 0, 1.0).expect("text")).expect("the same");
        assert_eq!(again, found);
    }

    /// The tip of the arrow of a moved point is where the point came to, exaggerated; every judgement has a mesh of its own.
    #[test]
    fn a_scene_has_an_arrow_of_each_point() {
        let found = found();
        let bytes = write(&found, "gltf", 0, 100.0).expect("a scene");
        assert_eq!((&bytes[..4], bytes.len() % 4), (&b"glTF"[..], 0));
        let length = u32::from_le_bytes(bytes[12..16].try_into().expect("four bytes")) as usize;
        let scene: serde_json::Value = serde_json::from_slice(&bytes[20..20 + length]).expect("a document");
        let nodes = scene["nodes"].as_array().expect("nodes");
        let node = |name: &str| nodes.iter().find(|n| n["name"] == name).unwrap_or_else(|| panic!("{name}"));
        assert_eq!(node("arrows moved")["extras"]["exaggeration"], 100.0);
        assert_eq!(node("arrows moved")["extras"]["names"], serde_json::json!(["p,8"]));
        assert_eq!(node("arrows reference")["extras"]["names"].as_array().map(Vec::len), Some(8));
        let primitive =
            &scene["meshes"][node("arrows moved")["mesh"].as_u64().expect("a mesh") as usize]["primitives"][0];
        let accessor = &scene["accessors"][primitive["attributes"]["POSITION"].as_u64().expect("positions") as usize];
        let middle = node("object")["translation"][2].as_f64().expect("a middle");
        let point = &found.pairs[0].points[8];
        let tip = point.xyz[2] + 100.0 * point.difference[2] - middle;
        assert!((accessor["max"][2].as_f64().expect("a number") - tip).abs() < 1e-3 * tip.abs(), "{accessor} {tip}");
    }
}
