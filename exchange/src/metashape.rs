//! Projects of Agisoft Metashape: "Export cameras" and "Export markers" as XML, one or both of a project, and project files ([`archive`]).
//!
//! | convention | here |
//! | --- | --- |
//! | pixel origin, lens | as [`agisoft_lens`](super::agisoft_lens) |
//! | axes | camera: x right, y down, z forwards |
//! | rotation | `transform` of a camera takes camera coordinates to the chunk, that of its component or chunk takes these to the object: X = s R x + T |
//! | scale bars | between two markers: `reference` with the length `d` in the unit of the system and its accuracy `sd`, else that of the settings; disabled ones are compared only |
//! | markers | pixels in our frame; `pinned` ones are measured, others predicted; reference coordinates are control where enabled, else check |
//!
//! Source: Agisoft Metashape User Manual and Python Reference (Camera.transform, Chunk.transform, Marker.Projection). With a local reference system
//! the object system is that of the reference coordinates. A geographic or projected one is another system than that of the
//! cameras, which is geocentric then: cameras and measurements are read and the reference coordinates are not. Tie points are in no file of
//! this export. Regions and reference coordinates of cameras are counted.

pub mod archive;

use std::collections::HashMap;
use std::fmt::Write;

use nalgebra::{Matrix3, Vector3};

use super::agisoft_lens::{self, METASHAPE, number, numbers, pixels, wrong};
use super::dbat::element::{self, Element};
use super::foreign::{Assumed, ForeignCamera, ForeignModel, Pose};
use super::lens::Lens;
use super::network::{self, ForeignNetwork, Models, OutgoingNetwork};
use super::{Files, encoding};
use sightline::error::{Error, Place, Reason, Result, Thing};
use sightline::project::{Camera, Distance, Interior, Photo, Point, Project, Role, Sigma};

/// Whether a document is of this format.
pub fn recognises(root: &Element) -> bool {
    root.name == "document"
        && root.child("chunk").is_some_and(|chunk| chunk.child("cameras").is_some() || chunk.child("markers").is_some())
}

/// A similarity X = s R x + T.
#[derive(Clone, Copy)]
struct Similarity {
    scale: f64,
    rotation: Matrix3<f64>,
    translation: Vector3<f64>,
}

const IDENTITY: Similarity = Similarity {
    scale: 1.0,
    rotation: Matrix3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0),
    translation: Vector3::new(0.0, 0.0, 0.0),
};

/// A name that is needed.
fn need<'a>(element: &'a Element, name: &str) -> Result<&'a str> {
    let missing = || Error::Invalid {
        reason: Reason::Missing { name: name.into() },
        at: Place::field(format!("{}.{name}", element.name)),
    };
    element.attribute(name).ok_or_else(missing)
}

/// Truth of an attribute, true if it is not there.
fn holds(element: &Element, name: &str) -> bool {
    !matches!(element.attribute(name), Some("false" | "0"))
}

/// Children of a list element; none where it is not there. Groups of cameras are opened.
fn listed<'a>(chunk: &'a Element, list: &str, name: &'a str) -> Vec<&'a Element> {
    let Some(list) = chunk.child(list) else { return Vec::new() };
    let grouped = list.children("group").flat_map(|group| group.children(name));
    list.children(name).chain(grouped).collect()
}

/// A project from its files.
///
/// # Errors
/// [`Error::Invalid`] with file and element, [`Error::Unknown`] for what is named and not there.
pub fn read(files: &Files) -> Result<ForeignNetwork> {
    let mut documents = Vec::new();
    for (name, bytes) in files {
        let root = match archive::recognises(bytes) {
            true => archive::document(bytes),
            false => encoding::text(bytes).and_then(|text| element::parse(&text)),
        };
        let root = archive::levelled(root.map_err(|error| error.in_file(name))?);
        if !(recognises(&root) || archive::recognises(bytes)) {
            return Err(wrong("document", "a document with a chunk of cameras or markers", &root.name).in_file(name));
        }
        documents.push((name, root));
    }
    // The file with sensors is the one of the cameras; names of the others are looked up by labels.
    documents.sort_by_key(|(_, root)| root.child("chunk").is_some_and(|chunk| chunk.child("sensors").is_none()));
    join_frames(&mut documents);
    let mut reader = ChunkReader::default();
    for (name, root) in &documents {
        let chunks = root.children("chunk").count();
        reader.network.notes.ignore("further chunks", chunks.saturating_sub(1));
        let Some(chunk) = root.child("chunk") else { continue };
        reader.chunk(chunk).map_err(|error| error.in_file(name))?;
    }
    let network = &mut reader.network;
    if network.observations.iter().any(|seen| seen.sigma == Sigma::One(1.0)) {
        network.notes.assume(Assumed::SigmaOnePixel);
    }
    Ok(reader.network)
}

/// Puts frames that came as files of their own into the chunk that they are of, where there is one chunk: they name photos and points by its
/// numbers.
fn join_frames(documents: &mut Vec<(&String, Element)>) {
    let alone = |root: &Element| {
        root.child("chunk").is_some_and(|chunk| chunk.children.iter().all(|child| child.name == "frames"))
    };
    let (frames, mut whole): (Vec<_>, Vec<_>) =
        std::mem::take(documents).into_iter().partition(|(_, root)| alone(root));
    if let [(_, root)] = &mut whole[..]
        && let Some(chunk) = root.children.iter_mut().find(|child| child.name == "chunk")
    {
        let content = frames.into_iter().flat_map(|(_, root)| root.children).flat_map(|chunk| chunk.children);
        let content: Vec<Element> = content.flat_map(|list| list.children).collect();
        if !content.is_empty() {
            chunk.children.retain(|child| child.name != "frames");
            chunk.children.push(Element { name: "frames".into(), children: content, ..Element::default() });
        }
    } else {
        whole.extend(frames);
    }
    *documents = whole;
}

#[derive(Default)]
struct ChunkReader {
    network: ForeignNetwork,
    /// Places of points by label.
    points: HashMap<String, usize>,
    /// Identifiers of photos by label; `None` if two have it.
    labels: HashMap<String, Option<String>>,
}

impl ChunkReader {
    fn chunk(&mut self, chunk: &Element) -> Result<()> {
        if self.network.name.is_empty() {
            self.network.name = chunk.attribute("label").unwrap_or_default().to_owned();
        }
        let reference = chunk.child("reference").map(|reference| reference.text.clone()).unwrap_or_default();
        let local = reference.is_empty() || reference.starts_with("LOCAL_CS");
        if !local {
            self.network.notes.assume(Assumed::SystemOfChunk);
        }
        if reference.contains("UNIT[\"metre\"") && local {
            self.network.unit = Some("m".into());
        }
        self.sensors(chunk)?;
        let of_camera = self.cameras(chunk)?;
        let of_marker = self.markers(chunk, local)?;
        self.projections(chunk, &of_camera, &of_marker)?;
        self.scale_bars(chunk, &of_marker)?;
        for child in &chunk.children {
            let read = [
                "sensors",
                "components",
                "cameras",
                "markers",
                "frames",
                "reference",
                "transform",
                "settings",
                "scalebars",
            ];
            if !read.contains(&child.name.as_str()) {
                self.network.notes.ignore(&child.name, 1);
            }
        }
        Ok(())
    }

    fn sensors(&mut self, chunk: &Element) -> Result<()> {
        for sensor in listed(chunk, "sensors", "sensor") {
            let id = need(sensor, "id")?.to_owned();
            let at = |error: Error| match error {
                Error::Invalid { reason, at } => {
                    Error::Invalid { reason, at: Place { camera: Some(id.clone()), ..at } }
                }
                other => other,
            };
            let calibrations: Vec<&Element> = sensor.children("calibration").collect();
            let adjusted = calibrations.iter().find(|c| c.attribute("class") == Some("adjusted"));
            let calibration = adjusted.or(calibrations.first()).copied();
            let resolution = calibration.and_then(|c| c.child("resolution")).or_else(|| sensor.child("resolution"));
            let resolution = resolution.ok_or_else(|| at(wrong("sensor", "a resolution", "none")))?;
            let side = |name: &str| need(resolution, name).and_then(|text| pixels(name, text)).map_err(at);
            let size = [side("width")?, side("height")?];
            let mut camera = match calibration {
                Some(calibration) => {
                    let projection =
                        calibration.attribute("type").or_else(|| sensor.attribute("type")).unwrap_or("frame");
                    let lens = agisoft_lens::lens(calibration, projection, size).map_err(at)?;
                    ForeignCamera::new(id.clone(), size, &METASHAPE, lens)
                }
                None => unknown(&id, size),
            };
            if let Some(covariance) = sensor.child("covariance") {
                camera.covariance = agisoft_lens::covariance(covariance).map_err(at)?;
            }
            self.network.cameras.push(camera);
        }
        Ok(())
    }

    /// Photos; identifiers by the numbers of the file.
    fn cameras(&mut self, chunk: &Element) -> Result<HashMap<String, String>> {
        let mut transforms: HashMap<&str, Similarity> = HashMap::new();
        for component in listed(chunk, "components", "component") {
            if let Some(transform) = component.child("transform") {
                transforms.insert(need(component, "id")?, similarity(transform)?);
            }
        }
        let whole = chunk.child("transform").map(similarity).transpose()?;
        let mut ids = HashMap::new();
        let cameras = listed(chunk, "cameras", "camera");
        let mut labels: HashMap<&str, usize> = HashMap::new();
        for camera in &cameras {
            *labels.entry(camera.attribute("label").unwrap_or_default()).or_default() += 1;
        }
        for camera in cameras {
            let number = need(camera, "id")?;
            let label = camera.attribute("label").unwrap_or(number);
            let Some(sensor) = camera.attribute("sensor_id") else {
                // The file of the markers names the photos only.
                match self.labels.get(label) {
                    Some(Some(id)) => {
                        ids.insert(number.to_owned(), id.clone());
                    }
                    Some(None) => return Err(wrong("camera", "a label that one photo has", label)),
                    None => self.network.notes.ignore("photos without a sensor", 1),
                }
                continue;
            };
            let id = if labels.get(label) == Some(&1) { label.to_owned() } else { format!("{label} ({number})") };
            let component = camera.attribute("component_id").and_then(|id| transforms.get(id)).copied();
            let moved = component.or(whole).unwrap_or(IDENTITY);
            let pose = camera.child("transform").map(|transform| pose(transform, &moved)).transpose()?;
            let mut photo: Photo = network::photo(id.clone(), sensor.to_owned(), label, pose);
            photo.enabled = holds(camera, "enabled");
            self.network.notes.ignore("reference coordinates of cameras", camera.children("reference").count());
            self.network.photos.push(photo);
            self.labels.entry(label.to_owned()).and_modify(|id| *id = None).or_insert(Some(id.clone()));
            ids.insert(number.to_owned(), id);
        }
        Ok(ids)
    }

    /// Points; identifiers by the numbers of the file.
    fn markers(&mut self, chunk: &Element, local: bool) -> Result<HashMap<String, String>> {
        let settings = |name: &str| -> Result<Option<f64>> {
            let all = chunk.child("settings").into_iter().flat_map(|settings| settings.children("property"));
            let found = all.filter(|p| p.attribute("name") == Some(name)).find_map(|p| p.attribute("value"));
            // "0.1" or one figure an axis.
            found.and_then(|text| text.split(['/', ' ']).next()).map(|text| number(name, text)).transpose()
        };
        let usual = settings("accuracy_markers")?.filter(|sigma| *sigma > 0.0);
        let mut ids = HashMap::new();
        for marker in listed(chunk, "markers", "marker") {
            let number_of = need(marker, "id")?.to_owned();
            let id = marker.attribute("label").filter(|label| !label.is_empty()).unwrap_or(&number_of).to_owned();
            let place = *self.points.entry(id.clone()).or_insert_with(|| {
                self.network.points.push(Point { id: id.clone(), ..Point::default() });
                self.network.points.len() - 1
            });
            ids.insert(number_of, id.clone());
            let Some(reference) = marker.child("reference").filter(|r| r.attribute("x").is_some()) else { continue };
            if !local {
                self.network.notes.ignore("reference coordinates of markers", 1);
                continue;
            }
            let axis =
                |name: &str| need(reference, name).and_then(|text| number(name, text)).map_err(|e| in_point(e, &id));
            let sigma = |name: &str| -> Result<Option<f64>> {
                let own = reference
                    .attribute(name)
                    .map(|text| number(name, text))
                    .transpose()
                    .map_err(|e| in_point(e, &id))?;
                Ok(own.filter(|sigma| *sigma > 0.0).or(usual))
            };
            let point = &mut self.network.points[place];
            point.xyz = Some([axis("x")?, axis("y")?, axis("z")?]);
            let sigmas = [sigma("sx")?, sigma("sy")?, sigma("sz")?];
            point.sigma = sigmas.iter().any(Option::is_some).then_some(sigmas);
            point.role = if holds(reference, "enabled") { Role::Control } else { Role::Check };
        }
        Ok(ids)
    }

    fn scale_bars(&mut self, chunk: &Element, of_marker: &HashMap<String, String>) -> Result<()> {
        let settings = chunk.child("settings").into_iter().flat_map(|settings| settings.children("property"));
        let usual = settings.filter(|p| p.attribute("name") == Some("accuracy_scalebars"));
        let usual = usual.filter_map(|p| p.attribute("value")).next();
        let usual = usual.map(|text| number("accuracy_scalebars", text)).transpose()?.filter(|sigma| *sigma > 0.0);
        for bar in listed(chunk, "scalebars", "scalebar") {
            let ends: Vec<&str> = bar.children("endpoint").filter_map(|end| end.attribute("marker_id")).collect();
            let [from, to] = ends[..] else {
                self.network.notes.ignore("scale bars that end at a camera", 1);
                continue;
            };
            let marker = |id: &str| {
                let unknown =
                    || Error::Unknown { kind: Thing::Point, name: id.into(), at: Place::field("scalebar.endpoint") };
                of_marker.get(id).cloned().ok_or_else(unknown)
            };
            let (from, to) = (marker(from)?, marker(to)?);
            let Some(reference) = bar.child("reference").filter(|reference| reference.attribute("d").is_some()) else {
                self.network.notes.ignore("scale bars without a length", 1);
                continue;
            };
            let in_bar = |error| in_point(error, &from);
            let length = need(reference, "d").and_then(|text| number("d", text)).map_err(in_bar)?;
            let own = reference.attribute("sd").map(|text| number("sd", text)).transpose().map_err(in_bar)?;
            let Some(sigma) = own.filter(|sigma| *sigma > 0.0).or(usual) else {
                self.network.notes.ignore("scale bars without an accuracy", 1);
                continue;
            };
            if !(length > 0.0) {
                return Err(in_bar(wrong("d", "a length above 0", &length.to_string())));
            }
            let check = !holds(reference, "enabled");
            self.network.distances.push(Distance { from, to, length, sigma, check });
        }
        Ok(())
    }

    fn projections(
        &mut self,
        chunk: &Element,
        of_camera: &HashMap<String, String>,
        of_marker: &HashMap<String, String>,
    ) -> Result<()> {
        let all = chunk.child("settings").into_iter().flat_map(|settings| settings.children("property"));
        let sigma =
            all.filter(|p| p.attribute("name") == Some("accuracy_projections")).find_map(|p| p.attribute("value"));
        let sigma = sigma.map(|text| number("accuracy_projections", text)).transpose()?.filter(|sigma| *sigma > 0.0);
        let frames = listed(chunk, "frames", "frame");
        self.network.notes.ignore("further frames", frames.len().saturating_sub(1));
        let Some(frame) = frames.first() else { return Ok(()) };
        for marker in listed(frame, "markers", "marker") {
            let number_of = need(marker, "marker_id")?;
            let unknown =
                || Error::Unknown { kind: Thing::Point, name: number_of.into(), at: Place::field("marker_id") };
            let point = of_marker.get(number_of).ok_or_else(unknown)?;
            for location in marker.children("location") {
                let camera = need(location, "camera_id")?;
                let Some(photo) = of_camera.get(camera) else {
                    self.network.notes.ignore("measurements in photos without a sensor", 1);
                    continue;
                };
                let axis = |name: &str| {
                    need(location, name).and_then(|text| number(name, text)).map_err(|e| in_point(e, point))
                };
                let mut seen = network::observation(photo, point, [axis("x")?, axis("y")?]);
                if let Some(sigma) = sigma {
                    seen.sigma = Sigma::One(sigma);
                }
                // Without the attribute it is one that a person set.
                seen.enabled = holds(location, "pinned") && holds(location, "valid");
                self.network.observations.push(seen);
            }
        }
        Ok(())
    }
}

fn in_point(error: Error, point: &str) -> Error {
    match error {
        Error::Invalid { reason, at } => Error::Invalid { reason, at: Place { point: Some(point.to_owned()), ..at } },
        other => other,
    }
}

/// A camera whose principal distance is not known.
fn unknown(id: &str, [width, height]: [u32; 2]) -> ForeignCamera {
    let (cx, cy) = (f64::from(width) / 2.0, f64::from(height) / 2.0);
    let interior = Interior::Opencv { fx: None, fy: None, cx, cy, k1: 0.0, k2: 0.0, p1: 0.0, p2: 0.0, k3: 0.0 };
    let model = ForeignModel::Correction(Camera::new(id, width, height, interior), None);
    ForeignCamera { id: id.to_owned(), size: [width, height], model, pose: None, region: None, covariance: None }
}

fn similarity(transform: &Element) -> Result<Similarity> {
    let text = |name: &str| transform.child(name).map(|child| child.text.as_str());
    let rotation = match text("rotation") {
        Some(text) => numbers::<9>("rotation", text)?,
        None => [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
    };
    let translation = text("translation").map_or(Ok([0.0; 3]), |text| numbers::<3>("translation", text))?;
    let scale = text("scale").map_or(Ok(1.0), |text| number("scale", text))?;
    if !(scale > 0.0) {
        return Err(wrong("scale", "a number above 0", &scale.to_string()));
    }
    Ok(Similarity { scale, rotation: Matrix3::from_row_slice(&rotation), translation: translation.into() })
}

/// The pose of a camera-to-chunk transform in the object system.
fn pose(transform: &Element, moved: &Similarity) -> Result<Pose> {
    let m = numbers::<16>("transform", &transform.text)?;
    let rotation = Matrix3::from_fn(|i, k| m[4 * i + k]);
    let centre = Vector3::new(m[3], m[7], m[11]);
    let centre = moved.scale * (moved.rotation * centre) + moved.translation;
    let to_camera = (moved.rotation * rotation).transpose();
    Pose::at(to_camera, centre.into())
        .ok_or_else(|| wrong("transform", "a rotation and a translation", &transform.text))
}

/// Models that are written.
pub const WRITES: Models<'static> = (&[&METASHAPE], |_| Lens::default());

/// `cameras.xml` and `markers.xml`; the chunk is in the object system.
///
/// # Errors
/// [`Reason::CannotWriteJson`].
pub fn write(project: &Project, network: &OutgoingNetwork) -> Result<Files> {
    let mut text = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<document version=\"2.0.0\">\n");
    let label = escaped(if project.name.is_empty() { "Chunk 1" } else { &project.name });
    let _ = writeln!(
        text,
        "  <chunk label=\"{label}\" enabled=\"true\">\n    <sensors next_id=\"{}\">",
        network.cameras.len()
    );
    for (k, (camera, out)) in network.cameras.iter().enumerate() {
        let (id, width, height) = (escaped(&camera.id), camera.width, camera.height);
        let _ = writeln!(text, "      <sensor id=\"{k}\" label=\"{id}\" type=\"frame\">");
        let _ = writeln!(text, "        <resolution width=\"{width}\" height=\"{height}\"/>");
        if let Some([x, y]) = camera.pixel_pitch {
            let _ = writeln!(
                text,
                "        <property name=\"pixel_width\" value=\"{x:?}\"/>\n        <property name=\"pixel_height\" value=\"{y:?}\"/>"
            );
        }
        let _ = writeln!(
            text,
            "        <calibration type=\"frame\" class=\"adjusted\">\n          <resolution width=\"{width}\" height=\"{height}\"/>"
        );
        text += &agisoft_lens::elements(out, camera, "          ")?;
        text += "        </calibration>\n      </sensor>\n";
    }
    text += "    </sensors>\n    <components next_id=\"1\" active_id=\"0\">\n      <component id=\"0\" label=\"Component 1\">\n        <transform>\n          <rotation>1 0 0 0 1 0 0 0 1</rotation>\n          <translation>0 0 0</translation>\n          <scale>1</scale>\n        </transform>\n      </component>\n    </components>\n";
    let _ = writeln!(text, "    <cameras next_id=\"{}\" next_group_id=\"0\">", network.photos.len());
    for (k, photo) in network.photos.iter().enumerate() {
        let label = escaped(&photo.file);
        let _ = writeln!(
            text,
            "      <camera id=\"{k}\" sensor_id=\"{}\" component_id=\"0\" label=\"{label}\" enabled=\"true\">",
            photo.camera
        );
        let (r, [x, y, z]) = (photo.pose.rotation, photo.pose.position);
        let _ = writeln!(
            text,
            "        <transform>{:?} {:?} {:?} {x:?} {:?} {:?} {:?} {y:?} {:?} {:?} {:?} {z:?} 0 0 0 1</transform>\n      </camera>",
            r[(0, 0)],
            r[(1, 0)],
            r[(2, 0)],
            r[(0, 1)],
            r[(1, 1)],
            r[(2, 1)],
            r[(0, 2)],
            r[(1, 2)],
            r[(2, 2)]
        );
    }
    // The file states its unit in metres: lengths in an unknown unit are refused, not written as metres.
    let metres = sightline::units::factor(&project.unit, "m")?;
    let reference = format!(
        "    <reference>LOCAL_CS[\"Local Coordinates ({})\",LOCAL_DATUM[\"Local Datum\",0],UNIT[\"{}\",{metres:?}]]</reference>\n",
        escaped(&project.unit),
        if metres == 1.0 { "metre".to_owned() } else { escaped(&project.unit) }
    );
    text += "    </cameras>\n";
    text += &reference;
    text += "  </chunk>\n</document>\n";
    let files = Files::from([
        ("cameras.xml".to_owned(), text.into_bytes()),
        ("markers.xml".to_owned(), markers(project, network, &label, &reference).into_bytes()),
    ]);
    network::with_companion(files, network)
}

fn markers(project: &Project, network: &OutgoingNetwork, label: &str, reference: &str) -> String {
    let mut text = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<document version=\"2.0.0\">\n  <chunk label=\"{label}\" enabled=\"true\">\n"
    );
    let _ = writeln!(text, "    <cameras next_id=\"{}\" next_group_id=\"0\">", network.photos.len());
    for (k, photo) in network.photos.iter().enumerate() {
        let _ = writeln!(text, "      <camera id=\"{k}\" label=\"{}\"/>", escaped(&photo.file));
    }
    let _ = writeln!(text, "    </cameras>\n    <markers next_id=\"{}\" next_group_id=\"0\">", network.points.len());
    let given: HashMap<&str, &Point> = project.points.iter().map(|point| (point.id.as_str(), point)).collect();
    for (k, point) in network.points.iter().enumerate() {
        let _ = write!(text, "      <marker id=\"{k}\" label=\"{}\">", escaped(&point.id));
        if let Some(point) = given.get(point.id.as_str()).filter(|point| point.role != Role::Tie)
            && let Some([x, y, z]) = point.xyz
        {
            let _ = write!(text, "\n        <reference x=\"{x:?}\" y=\"{y:?}\" z=\"{z:?}\"");
            for (name, sigma) in ["sx", "sy", "sz"].into_iter().zip(point.sigma.unwrap_or_default()) {
                if let Some(sigma) = sigma {
                    let _ = write!(text, " {name}=\"{sigma:?}\"");
                }
            }
            let _ = write!(text, " enabled=\"{}\"/>\n      ", point.role == Role::Control);
        }
        text += "</marker>\n";
    }
    text += "    </markers>\n    <frames next_id=\"1\">\n      <frame id=\"0\">\n        <markers>\n";
    for (k, point) in network.points.iter().enumerate() {
        let _ = writeln!(text, "          <marker marker_id=\"{k}\">");
        for (photo, place) in &point.seen {
            let [u, v] = network.photos[*photo].measured[*place].0;
            let _ =
                writeln!(text, "            <location camera_id=\"{photo}\" pinned=\"true\" x=\"{u:?}\" y=\"{v:?}\"/>");
        }
        text += "          </marker>\n";
    }
    text += "        </markers>\n      </frame>\n    </frames>\n";
    let numbers: HashMap<&str, usize> = network.points.iter().enumerate().map(|(k, p)| (p.id.as_str(), k)).collect();
    let bars =
        project.distances.iter().filter_map(|d| Some((d, numbers.get(d.from.as_str())?, numbers.get(d.to.as_str())?)));
    let _ = writeln!(text, "    <scalebars next_id=\"{}\" next_group_id=\"0\">", project.distances.len());
    for (k, (distance, from, to)) in bars.enumerate() {
        let (label, length, sigma) =
            (escaped(&format!("{}_{}", distance.from, distance.to)), distance.length, distance.sigma);
        let _ = writeln!(
            text,
            "      <scalebar id=\"{k}\" label=\"{label}\">\n        <endpoint marker_id=\"{from}\"/>\n        <endpoint marker_id=\"{to}\"/>\n        \
             <reference d=\"{length:?}\" sd=\"{sigma:?}\" enabled=\"{}\"/>\n      </scalebar>",
            !distance.check
        );
    }
    text += "    </scalebars>\n";
    text += reference;
    text += "  </chunk>\n</document>\n";
    text
}

fn escaped(text: &str) -> String {
    let kept: String = text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    quick_xml::escape::escape(kept.as_str()).into_owned()
}
