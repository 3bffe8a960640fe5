//! Cameras of mrcal (`.cameramodel`), the literal of a Python dictionary.
//!
//! | convention | here |
//! | --- | --- |
//! | pixel origin | the centre of the first pixel is (0, 0): cx, cy are ours - 0.5 |
//! | axes | x right, y down, z forwards; a = X/Z, b = Y/Z |
//! | distortion | ideal to image: `LENSMODEL_OPENCV4`, 5, 8, 12 with the coefficients of OpenCV in its order, `LENSMODEL_PINHOLE` |
//! | pose | `extrinsics` (before 2.5: `rt_fromref`): rotation vector and translation that take the reference into the camera |
//!
//! Source: mrcal's documentation, "Camera model representation" and "Lens models". Splined, stereographic, latitude-longitude and CAHVOR models are
//! refused by name. `optimization_inputs` (the observations of the calibration, packed) are not read; a camera that is written again loses them,
//! since changed parameters make them invalid.

use crate::reason::ExchangeReason;
use std::fmt::Write;

use nalgebra::{Rotation3, Vector3};
use serde_json::{Map, Value};

use super::Files;
use super::foreign::{self, CameraOptions, ExportedCamera, ForeignCamera, Notes, Pose};
use super::lens::Lens;
use super::opencv::{self, MODELS, PIXEL};
use super::tree::{self, Node, real};
use sightline::error::{Error, Place, Reason, Result, shortened};
use sightline::project::Camera;

/// Whether a text is of this format.
pub fn recognises(text: &str) -> bool {
    text.contains("LENSMODEL_") && text.contains("intrinsics")
}

/// The camera of a text.
///
/// # Errors
/// [`Error::Invalid`] with line or element; [`ExchangeReason::NoSuchCameraModel`] for a lens that is not perspective.
pub fn read(text: &str, id: &str, notes: &mut Notes) -> Result<Vec<ForeignCamera>> {
    let tree = literal(text)?;
    let root = Node::root(&tree);
    let model = root.any(&["lensmodel", "lens_model"]).map_or_else(|| root.need("lensmodel"), Ok)?;
    let name = model.text()?;
    let intrinsics = root.need("intrinsics")?;
    let values = intrinsics.numbers()?;
    let count = match name.as_str() {
        "LENSMODEL_PINHOLE" => 0,
        "LENSMODEL_OPENCV4" => 4,
        "LENSMODEL_OPENCV5" => 5,
        "LENSMODEL_OPENCV8" => 8,
        "LENSMODEL_OPENCV12" => 12,
        other => return Err(model.invalid(ExchangeReason::NoSuchCameraModel { model: shortened(other) }.into())),
    };
    if values.len() != 4 + count || !(values[0] > 0.0 && values[1] > 0.0) {
        return Err(intrinsics.expected(&format!("fx, fy, cx, cy and {count} coefficients")));
    }
    let focal = [values[0], values[1], values[2], values[3], 0.0];
    let (shape, lens) = opencv::lens(focal, &values[4..], PIXEL, &intrinsics)?;
    let size = root.need("imagersize")?;
    let [width, height] = &size.items()?[..] else { return Err(size.expected("width and height")) };
    let mut camera = ForeignCamera::new(id, [width.size()?, height.size()?], shape, lens);
    if let Some(pose) = root.any(&["extrinsics", "rt_cam_ref"]) {
        let [rx, ry, rz, tx, ty, tz] = pose.exactly()?;
        let rotation = *Rotation3::new(Vector3::new(rx, ry, rz)).matrix();
        camera.pose = Some(Pose::new(rotation, [tx, ty, tz]).ok_or_else(|| pose.expected("a rotation vector"))?);
    }
    if let Some(region) = root.get("valid_intrinsics_region") {
        let corner = |node: &Node<'_>| node.exactly::<2>().map(|[u, v]| [u + PIXEL, v + PIXEL]);
        let mut polygon = region.items()?.iter().map(corner).collect::<Result<Vec<_>>>()?;
        // Closed polygons name their first corner twice. Their corners may lie beyond the picture's outermost pixels by half of one.
        if polygon.len() > 1 && polygon.first() == polygon.last() {
            polygon.pop();
        }
        if polygon.len() >= 3 {
            camera.region = Some(polygon);
        }
    }
    let read =
        ["lensmodel", "lens_model", "intrinsics", "imagersize", "extrinsics", "rt_cam_ref", "valid_intrinsics_region"];
    for name in root.names().into_iter().filter(|name| !read.contains(name)) {
        notes.ignore(name, 1);
    }
    Ok(vec![camera])
}

/// The camera as a model, with the region that is used as its valid region.
///
/// # Errors
/// As [`foreign::outgoing`].
pub fn write(camera: &Camera, pose: Option<&Pose>, options: &CameraOptions) -> Result<ExportedCamera> {
    let models = [MODELS[0], MODELS[1], MODELS[2], MODELS[3]];
    let out = foreign::outgoing(camera, &models, &Lens::default(), options)?;
    let mut values = out.values.clone();
    values[2] -= PIXEL;
    values[3] -= PIXEL;
    let name = format!("LENSMODEL_OPENCV{}", values.len() - 4);
    let list = |values: &[f64]| values.iter().map(|value| real(*value)).collect::<Vec<_>>().join(", ");
    let (rotation, translation) =
        pose.map_or(([0.0; 3], [0.0; 3]), |pose| (pose.rotation_vector(), pose.translation()));
    let mut text = String::from("{\n");
    let _ = writeln!(text, "    'lensmodel':  '{name}',\n");
    let _ = writeln!(text, "    # intrinsics are fx,fy,cx,cy,distortion0,distortion1,....");
    let _ = writeln!(text, "    'intrinsics': [ {} ],\n", list(&values));
    if let Some(region) = &options.region {
        let corners =
            region.iter().chain(region.first()).map(|[u, v]| format!("    [ {} ],\n", list(&[u - PIXEL, v - PIXEL])));
        let _ = writeln!(text, "    'valid_intrinsics_region': [\n{}],\n", corners.collect::<String>());
    }
    let _ = writeln!(text, "    # extrinsics are rt_fromref");
    let _ = writeln!(text, "    'extrinsics': [ {}, {} ],\n", list(&rotation), list(&translation));
    let _ = writeln!(text, "    'imagersize': [ {}, {} ]\n}}", camera.width, camera.height);
    let mut files = Files::from([("camera.cameramodel".to_owned(), text.into_bytes())]);
    if let Some(covariance) = &out.covariance {
        files.extend([foreign::covariance_file(&camera.id, &name, covariance)?]);
    }
    let (conversion, covariance) = (out.conversion, out.covariance);
    Ok(ExportedCamera { files, conversion, covariance, ignored: foreign::unkept(camera, false) })
}

/// A literal of Python: dictionaries, lists, tuples, texts, bytes, numbers, True, False, None; comments begin with #.
fn literal(text: &str) -> Result<Value> {
    let mut reader = LiteralReader { text, at: 0 };
    let value = reader.value(0)?;
    match reader.peek() {
        None => Ok(value),
        Some(_) => Err(reader.expected("the end of the file")),
    }
}

/// Deepest nesting of a literal.
const DEPTH_LIMIT: usize = 16;

struct LiteralReader<'a> {
    text: &'a str,
    at: usize,
}

impl LiteralReader<'_> {
    fn rest(&self) -> &str {
        &self.text[self.at..]
    }

    fn invalid(&self, reason: Reason) -> Error {
        let line = self.text.as_bytes()[..self.at].iter().filter(|byte| **byte == b'\n').count() + 1;
        Error::Invalid { reason, at: Place::line(line) }
    }

    fn expected(&self, expected: &str) -> Error {
        let found = self.rest().lines().next().unwrap_or_default();
        if found.is_empty() && self.rest().is_empty() {
            return self.invalid(ExchangeReason::EndsWhere { expected: expected.into() }.into());
        }
        self.invalid(ExchangeReason::ExpectedHere { expected: expected.into(), found: shortened(found) }.into())
    }

    /// The next character after blanks and comments.
    fn peek(&mut self) -> Option<char> {
        loop {
            let rest = self.rest();
            let blank = rest.len() - rest.trim_start().len();
            self.at += blank;
            if !self.rest().starts_with('#') {
                return self.rest().chars().next();
            }
            self.at += self.rest().find('\n').unwrap_or(self.rest().len());
        }
    }

    /// Passes over a mark, if it stands here.
    fn passes(&mut self, mark: char) -> bool {
        let here = self.peek() == Some(mark);
        if here {
            self.at += mark.len_utf8();
        }
        here
    }

    fn value(&mut self, depth: usize) -> Result<Value> {
        if depth > DEPTH_LIMIT {
            return Err(self.expected("a literal that is nested less deeply"));
        }
        match self.peek() {
            Some('{') => {
                self.at += 1;
                let mut fields = Map::new();
                while !self.passes('}') {
                    let Value::String(name) = self.value(depth + 1)? else { return Err(self.expected("a name")) };
                    if !self.passes(':') {
                        return Err(self.expected(":"));
                    }
                    let value = self.value(depth + 1)?;
                    fields.insert(name, value);
                    if !self.passes(',') && self.peek() != Some('}') {
                        return Err(self.expected(", or }"));
                    }
                }
                Ok(Value::Object(fields))
            }
            Some(open @ ('[' | '(')) => {
                self.at += 1;
                let close = if open == '[' { ']' } else { ')' };
                let mut items = Vec::new();
                while !self.passes(close) {
                    items.push(self.value(depth + 1)?);
                    if !self.passes(',') && self.peek() != Some(close) {
                        return Err(self.expected(&format!(", or {close}")));
                    }
                }
                Ok(Value::Array(items))
            }
            Some('\'' | '"') => self.quoted(),
            Some('b' | 'r') if matches!(self.rest().as_bytes().get(1), Some(b'\'' | b'"')) => {
                self.at += 1;
                self.quoted()
            }
            _ => self.word(),
        }
    }

    /// A text; escapes stay as they stand, since no name or number has any.
    fn quoted(&mut self) -> Result<Value> {
        let quote = self.rest().chars().next().unwrap_or('\'');
        let mut escaped = false;
        let end = self.rest().char_indices().skip(1).find(|(_, c)| {
            let ends = *c == quote && !escaped;
            escaped = *c == '\\' && !escaped;
            ends
        });
        let Some((end, _)) = end else { return Err(self.expected("a text that ends")) };
        let text = self.rest()[1..end].to_owned();
        self.at += end + 1;
        Ok(Value::String(text))
    }

    fn word(&mut self) -> Result<Value> {
        let end = self.rest().find(|c: char| c.is_whitespace() || matches!(c, ',' | ']' | ')' | '}' | ':' | '#'));
        let word = &self.rest()[..end.unwrap_or(self.rest().len())];
        let value = match word {
            "True" => Value::Bool(true),
            "False" => Value::Bool(false),
            "None" => Value::Null,
            _ => match (word.parse::<i64>(), tree::number(word)) {
                (Ok(whole), _) => whole.into(),
                (_, Some(number)) => number.into(),
                _ => return Err(self.expected("a number, a text, a list or a dictionary")),
            },
        };
        self.at += word.len();
        Ok(value)
    }
}
