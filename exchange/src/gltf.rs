//! A scene for 3-D viewers (glTF 2.0, binary): points, exaggerated error ellipsoids, cameras, lines and features as nodes of their own.
//!
//! There Y is up and lengths are metres: the root turns and scales. Coordinates are single precision about the points' middle, whose place is
//! that of a node, so that no digits are lost in large coordinates.

use std::collections::HashMap;

use nalgebra::Vector3;
use serde_json::{Value, json};

use super::spatial::{Spatial, colour, sphere};
use sightline::adjustment::Adjustment;
use sightline::project::Project;

const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const UNSIGNED_BYTE: u32 = 5121;
pub(super) const POINTS: u32 = 0;
const LINES: u32 = 1;
pub(super) const TRIANGLES: u32 = 4;

/// Colour of features.
const FEATURE: [u8; 3] = [160, 0, 120];

/// Metres of a unit; 1 where it is not known.
pub(super) fn metres(unit: &str) -> f64 {
    match unit {
        "mm" => 0.001,
        "cm" => 0.01,
        "µm" => 1e-6,
        "in" => 0.0254,
        "ft" => 0.3048,
        _ => 1.0,
    }
}

/// Buffers of the scene with the names that distinguish them.
#[derive(Default)]
pub(super) struct Scene {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    materials: Vec<Value>,
    meshes: Vec<Value>,
    nodes: Vec<Value>,
}

/// The bytes of `scene.glb`.
pub fn write(project: &Project, adjustment: Option<&Adjustment>) -> Vec<u8> {
    let spatial = Spatial::of(project, adjustment);
    let about = |xyz: &[f64; 3]| -> [f32; 3] { std::array::from_fn(|k| (xyz[k] - spatial.centre[k]) as f32) };
    let mut scene = Scene::default();
    if !spatial.spots.is_empty() {
        let places: Vec<[f32; 3]> = spatial.spots.iter().map(|s| about(&s.xyz)).collect();
        let position = scene.positions(&places);
        let colours: Vec<u8> =
            spatial.spots.iter().flat_map(|s| colour(s.point.role).into_iter().chain([255])).collect();
        let colour = scene.accessor(&colours, (UNSIGNED_BYTE, "VEC4"), spatial.spots.len(), true);
        let names: Vec<&str> = spatial.spots.iter().map(|s| s.point.id.as_str()).collect();
        let attributes = json!({ "POSITION": position, "COLOR_0": colour });
        scene.mesh("points", attributes, None, POINTS, [255; 3], json!({ "names": names, "unit": project.unit }));
    }
    scene.ellipsoids(&spatial);
    let segments: Vec<[f32; 3]> = spatial
        .views
        .iter()
        .flat_map(|v| {
            let [centre, corners @ ..] = v.frustum;
            (0..4).flat_map(move |k| [centre, corners[k], corners[k], corners[(k + 1) % 4]])
        })
        .map(|xyz| about(&xyz))
        .collect();
    let photos: Vec<&str> = spatial.views.iter().map(|v| v.id).collect();
    scene.lines("cameras", &segments, [110; 3], json!({ "photos": photos }));
    let at: HashMap<&str, [f64; 3]> = spatial.spots.iter().map(|s| (s.point.id.as_str(), s.xyz)).collect();
    let mut layers: Vec<&str> = project.lines.iter().map(|l| l.layer.as_str()).collect();
    layers.sort_unstable();
    layers.dedup();
    for layer in layers {
        let own = project.lines.iter().filter(|l| l.layer == layer);
        let ends = own.filter_map(|l| Some([*at.get(l.from.as_str())?, *at.get(l.to.as_str())?])).flatten();
        let ends: Vec<[f32; 3]> = ends.map(|xyz| about(&xyz)).collect();
        let colour = project.layers.iter().find(|l| l.id == layer).map_or([0; 3], |l| l.colour);
        let name = if layer.is_empty() { "lines".to_owned() } else { format!("lines {layer}") };
        scene.lines(&name, &ends, colour, json!({ "layer": layer }));
    }
    for (feature, drawn) in &spatial.features {
        let name = format!("feature {}", feature.id);
        let extras = json!({ "kind": feature.kind, "value": feature.value, "sigma": feature.sigma });
        let outline: Vec<[f32; 3]> = drawn.outline.iter().flatten().map(about).collect();
        scene.lines(&name, &outline, FEATURE, extras.clone());
        let surface: Vec<[f32; 3]> = drawn.surface.iter().flatten().map(about).collect();
        if !surface.is_empty() {
            let position = scene.positions(&surface);
            let attributes = json!({ "POSITION": position });
            scene.mesh(&format!("{name} surface"), attributes, None, TRIANGLES, FEATURE, extras);
            scene.see_through(0.3);
        }
    }
    scene.packed(spatial.centre, metres(&project.unit))
}

impl Scene {
    fn accessor(&mut self, bytes: &[u8], (kind, shape): (u32, &str), count: usize, normalised: bool) -> usize {
        let offset = self.bytes.len();
        self.bytes.extend_from_slice(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.views.push(json!({ "buffer": 0, "byteOffset": offset, "byteLength": bytes.len() }));
        let view = self.views.len() - 1;
        self.accessors.push(json!({
            "bufferView": view, "componentType": kind, "count": count, "type": shape, "normalized": normalised,
        }));
        self.accessors.len() - 1
    }

    pub(super) fn positions(&mut self, places: &[[f32; 3]]) -> usize {
        let bytes: Vec<u8> = places.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
        let number = self.accessor(&bytes, (FLOAT, "VEC3"), places.len(), false);
        let limit = |pick: fn(f32, f32) -> f32, start: f32| -> [f32; 3] {
            std::array::from_fn(|k| places.iter().map(|p| p[k]).fold(start, pick))
        };
        self.accessors[number]["min"] = json!(limit(f32::min, f32::INFINITY));
        self.accessors[number]["max"] = json!(limit(f32::max, f32::NEG_INFINITY));
        number
    }

    pub(super) fn mesh(
        &mut self,
        name: &str,
        attributes: Value,
        indices: Option<usize>,
        mode: u32,
        colour: [u8; 3],
        extras: Value,
    ) {
        let [r, g, b] = colour.map(|c| (f64::from(c) / 255.0).powf(2.2));
        let lit = json!({ "baseColorFactor": [r, g, b, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.9 });
        self.materials.push(json!({ "name": name, "pbrMetallicRoughness": lit }));
        let mut primitive = json!({ "attributes": attributes, "mode": mode, "material": self.materials.len() - 1 });
        if let Some(indices) = indices {
            primitive["indices"] = json!(indices);
        }
        self.meshes.push(json!({ "name": name, "primitives": [primitive] }));
        self.nodes.push(json!({ "name": name, "mesh": self.meshes.len() - 1, "extras": extras }));
    }

    /// Lets what lies behind the last mesh be seen, from both of its sides.
    pub(super) fn see_through(&mut self, opacity: f64) {
        if let Some(material) = self.materials.last_mut() {
            material["pbrMetallicRoughness"]["baseColorFactor"][3] = json!(opacity);
            material["alphaMode"] = json!("BLEND");
            material["doubleSided"] = json!(true);
        }
    }

    fn lines(&mut self, name: &str, ends: &[[f32; 3]], colour: [u8; 3], extras: Value) {
        if !ends.is_empty() {
            let position = self.positions(ends);
            self.mesh(name, json!({ "POSITION": position }), None, LINES, colour, extras);
        }
    }

    /// All ellipsoids as one mesh: viewers are slow with thousands of nodes.
    fn ellipsoids(&mut self, spatial: &Spatial) {
        let (corners, faces) = sphere();
        let (mut places, mut indices) = (Vec::new(), Vec::<u8>::new());
        let mut count = 0;
        for (spot, axes) in spatial.spots.iter().filter_map(|s| Some((s, s.ellipsoid?))) {
            let first = places.len() as u32;
            let middle = Vector3::from(spot.xyz) - Vector3::from(spatial.centre);
            let corner = |c: &[f64; 3]| -> [f32; 3] {
                let at = middle + spatial.factor * (axes * Vector3::from(*c));
                [at.x as f32, at.y as f32, at.z as f32]
            };
            places.extend(corners.iter().map(corner));
            indices.extend(faces.iter().flatten().flat_map(|k| (first + k).to_le_bytes()));
            count += 3 * faces.len();
        }
        if count > 0 {
            let position = self.positions(&places);
            let indices = self.accessor(&indices, (UNSIGNED_INT, "SCALAR"), count, false);
            let extras = json!({ "sigma_level": 1, "exaggeration": spatial.factor });
            self.mesh("ellipsoids", json!({ "POSITION": position }), Some(indices), TRIANGLES, [0, 94, 184], extras);
        }
    }

    /// The file of everything, about a middle.
    pub(super) fn packed(mut self, centre: [f64; 3], metres: f64) -> Vec<u8> {
        let parts: Vec<usize> = (0..self.nodes.len()).collect();
        let middle = self.nodes.len();
        let mut middle_node = json!({ "name": "object", "translation": centre });
        if !parts.is_empty() {
            middle_node["children"] = json!(parts);
        }
        self.nodes.push(middle_node);
        // A quarter turn about X brings Z up to Y.
        let half = std::f64::consts::FRAC_1_SQRT_2;
        self.nodes.push(json!({
            "name": "Sightline", "children": [middle], "rotation": [-half, 0.0, 0.0, half], "scale": [metres, metres, metres],
        }));
        let mut document = json!({
            "asset": { "version": "2.0", "generator": "Sightline" },
            "scene": 0,
            "scenes": [{ "nodes": [middle + 1] }],
            "nodes": self.nodes,
        });
        let lists = [
            ("meshes", self.meshes),
            ("materials", self.materials),
            ("accessors", self.accessors),
            ("bufferViews", self.views),
        ];
        for (name, list) in lists.into_iter().filter(|(_, list)| !list.is_empty()) {
            document[name] = json!(list);
        }
        if !self.bytes.is_empty() {
            document["buffers"] = json!([{ "byteLength": self.bytes.len() }]);
        }
        let mut text = document.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut chunks = vec![(text, *b"JSON")];
        if !self.bytes.is_empty() {
            chunks.push((self.bytes, *b"BIN\0"));
        }
        let length = 12 + chunks.iter().map(|(bytes, _)| 8 + bytes.len()).sum::<usize>();
        let mut file = b"glTF".to_vec();
        file.extend(2_u32.to_le_bytes());
        file.extend((length as u32).to_le_bytes());
        for (bytes, kind) in chunks {
            file.extend((bytes.len() as u32).to_le_bytes());
            file.extend(kind);
            file.extend(bytes);
        }
        file
    }
}
