//! Plates measured on a comparator or in scans: a description of the camera and the machine's readings, in one text or
//! several.
//!
//! A line that starts with a keyword describes, any other is a reading: photo, mark or point, x, y. Fields are
//! separated by commas, semicolons or blanks; lines that start with # or % are comments.
//!
//! ```text
//! camera, p31                          name of the camera
//! c, 106.81                            principal distance, mm
//! plate, 127, 102                      width and height of the plate, mm; else the fiducial marks' extent
//! sigma, 0.003                         standard error of a reading, mm of the plate [0.003]
//! transformation, affine               similarity, affine or projective [affine]
//! y, up                                the machine's y axis; down for pixels of a scan [up]
//! fiducial, F1, -58.012, 45.987        a mark and its calibrated photo coordinates, mm
//! distortion, 10, 0.6                  radius in mm and outward displacement in µm, a line a radius
//! control, 5, 2992.25, 7026.83, 643.28, 0.001      a control point, with one standard error, three or none
//! ```

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::text::{self, Row};
use super::{Files, encoding};
use sightline::error::{Error, Lack, Place, Reason, Result, Thing, shortened};
use sightline::film::comparator::{InnerOrientation, Reading, Setup, Upwards, observations};
use sightline::film::distortion::{self, OddPolynomial};
use sightline::film::transformation::Kind;
use sightline::project::{Camera, DatumKind, Interior, Parameter, Photo, Point, Project, Role};

/// Millimetres per pixel of the grid that represents the plate; no result depends on it.
const PITCH_MM: f64 = 0.01;
/// Terms of the odd polynomial: r³, r⁵, r⁷, as K1, K2, K3.
const TERMS: usize = 3;

/// Largest number of a description: as that of readings, and the seventh power of a radius stays a number.
const LARGEST: f64 = 1e9;

/// Contents of the lines with keywords.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Description {
    /// Name of the camera.
    pub camera: String,
    /// Principal distance, millimetres.
    pub c: Option<f64>,
    /// Width and height of the plate, millimetres.
    pub plate: Option<[f64; 2]>,
    /// Fiducial marks, transformation, direction of y, sigma.
    pub setup: Setup,
    /// Radius in millimetres and outward displacement in micrometres.
    pub distortion: Vec<[f64; 2]>,
    /// Control points.
    pub control: Vec<Point>,
}

/// A fitted distortion table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FittedTable {
    /// Radius in millimetres and outward displacement in micrometres.
    pub table: Vec<[f64; 2]>,
    /// The polynomial, of millimetres.
    pub polynomial: OddPolynomial,
}

/// Plates reduced to a project, with the fits on the way.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Reduced {
    /// Camera, photos, points and observations; nothing is oriented.
    pub project: Project,
    /// Residuals at the fiducial marks, photo by photo.
    pub inner_orientations: Vec<InnerOrientation>,
    /// Residuals of the distortion table, where there is one.
    pub distortion: Option<FittedTable>,
}

/// Reads descriptions and readings.
///
/// # Errors
/// [`Error::Invalid`] with line and field.
pub fn parse(text: &str) -> Result<(Description, Vec<Reading>)> {
    let mut found = Description { setup: Setup { sigma: 0.003, ..Setup::default() }, ..Description::default() };
    let mut readings = Vec::new();
    read(text, &mut found, &mut readings)?;
    Ok((found, readings))
}

/// Reads the files of the format, in the order of their names.
///
/// # Errors
/// As [`parse`] and [`reduce`], with the file.
pub fn import(files: &Files) -> Result<Reduced> {
    let mut found = Description { setup: Setup { sigma: 0.003, ..Setup::default() }, ..Description::default() };
    let mut readings = Vec::new();
    for (name, bytes) in files {
        let text = encoding::text(bytes).and_then(|text| read(&text, &mut found, &mut readings));
        text.map_err(|error| error.in_file(name))?;
    }
    reduce(&found, &readings)
}

/// Whether files are of this format: one of them describes a fiducial mark.
pub fn recognises(files: &Files) -> bool {
    let describes = |text: &str| {
        text::rows(text).iter().any(|row| row.fields.first().is_some_and(|word| word.eq_ignore_ascii_case("fiducial")))
    };
    files.values().any(|bytes| encoding::text(bytes).is_ok_and(|text| describes(&text)))
}

/// The marks and points measured in a project's photos as readings: pixels of a scan, whose y axis points down.
pub fn readings_of(project: &Project) -> Vec<Reading> {
    let used = project.observations.iter().filter(|o| o.enabled);
    let reading =
        |o: &sightline::project::Observation| Reading { photo: o.photo.clone(), mark: o.point.clone(), x: o.u, y: o.v };
    used.map(reading).collect()
}

/// Readings transformed to the fiducial marks, with a camera whose K1, K2, K3 fit the distortion table.
///
/// # Errors
/// [`Error::Empty`] without readings or fiducial marks; [`Error::Invalid`] where marks or table determine no fit.
pub fn reduce(description: &Description, readings: &[Reading]) -> Result<Reduced> {
    let empty = |what| Err(Error::Empty { what });
    if readings.is_empty() {
        return empty(Lack::Readings);
    }
    if description.setup.fiducials.is_empty() {
        return empty(Lack::FiducialMarks);
    }
    let numbers =
        description.distortion.iter().flatten().chain(&description.c).chain(description.plate.iter().flatten());
    if numbers.into_iter().any(|value| value.abs() > LARGEST) {
        return Err(Error::Invalid { reason: Reason::NotFinite, at: Place::default() });
    }
    let distortion = fitted(&description.distortion)?;
    let camera = camera(description, distortion.as_ref().map(|d| &d.polynomial));
    let observed = observations(&camera, &description.setup, readings)?;
    let mut project = Project {
        points: description.control.clone().into(),
        observations: observed.observations.into(),
        cameras: vec![camera],
        ..Project::default()
    };
    if !project.points.is_empty() {
        project.datum.kind = DatumKind::Control;
    }
    super::name_photos_and_points(&mut project);
    let id = project.cameras[0].id.clone();
    project.photos.iter_mut().for_each(|photo: &mut Photo| photo.camera.clone_from(&id));
    Ok(Reduced { project, inner_orientations: observed.inner_orientations, distortion })
}

fn fitted(table: &[[f64; 2]]) -> Result<Option<FittedTable>> {
    if table.is_empty() {
        return Ok(None);
    }
    let (radii, millimetres): (Vec<f64>, Vec<f64>) = table.iter().map(|[r, d]| (*r, d / 1000.0)).unzip();
    let polynomial = distortion::fit(&radii, &millimetres, TERMS, false)?;
    Ok(Some(FittedTable { table: table.to_vec(), polynomial }))
}

fn camera(description: &Description, polynomial: Option<&OddPolynomial>) -> Camera {
    let mut interior = description.c.map_or_else(|| Interior::brown(0.0), Interior::brown);
    if let Interior::Brown { c, .. } = &mut interior {
        *c = description.c;
    }
    let coefficients = polynomial.map_or([0.0; 3], OddPolynomial::brown);
    for (parameter, value) in [Parameter::K1, Parameter::K2, Parameter::K3].into_iter().zip(coefficients) {
        interior.set(parameter, value);
    }
    let extent = |k: usize| {
        let reach = description.setup.fiducials.values().map(|place| place[k].abs()).fold(0.0, f64::max);
        description.plate.map_or(2.0 * reach, |size| size[k])
    };
    let pixels = |mm: f64| (mm / PITCH_MM).round().clamp(1.0, 1e6) as u32;
    let name = if description.camera.is_empty() { "film" } else { &description.camera };
    Camera { pixel_pitch: Some([PITCH_MM; 2]), ..Camera::new(name, pixels(extent(0)), pixels(extent(1)), interior) }
}

fn read(text: &str, found: &mut Description, readings: &mut Vec<Reading>) -> Result<()> {
    for row in text::rows(text) {
        if !describe(&row, found)? {
            // A heading has no numbers.
            let heading = row.fields.len() >= 4 && row.fields[2..4].iter().all(|f| text::number(f).is_none());
            if readings.is_empty() && heading {
                continue;
            }
            readings.push(Reading {
                photo: row.text(0, "photo")?.to_owned(),
                mark: row.text(1, "mark")?.to_owned(),
                x: row.number(2, "x")?,
                y: row.number(3, "y")?,
            });
        }
    }
    Ok(())
}

/// Takes a line that starts with a keyword; false for any other.
fn describe(row: &Row, found: &mut Description) -> Result<bool> {
    let positive = |index: usize, name: &str| row.positive(index, name);
    let unknown = |name: &str, choices: &str| {
        let text = shortened(row.fields.get(1).map_or("", String::as_str));
        Err(row.invalid(name, Reason::NoneOf { name: name.into(), choices: choices.into(), text }))
    };
    match row.fields.first().map(|word| word.to_ascii_lowercase()).as_deref() {
        Some("camera") => row.text(1, "camera")?.clone_into(&mut found.camera),
        Some("c") => found.c = Some(positive(1, "c")?),
        Some("plate") => found.plate = Some([positive(1, "width")?, positive(2, "height")?]),
        Some("sigma") => found.setup.sigma = positive(1, "sigma")?,
        Some("transformation") => match row.text(1, "transformation")?.to_ascii_lowercase().as_str() {
            "similarity" => found.setup.kind = Kind::Similarity,
            "affine" => found.setup.kind = Kind::Affine,
            "projective" => found.setup.kind = Kind::Projective,
            _ => return unknown("transformation", "similarity, affine, projective"),
        },
        Some("y") => match row.text(1, "y")?.to_ascii_lowercase().as_str() {
            "up" => found.setup.upwards = Upwards::Yes,
            "down" => found.setup.upwards = Upwards::No,
            _ => return unknown("y", "up, down"),
        },
        Some("fiducial") => {
            let mark = row.text(1, "mark")?.to_owned();
            let place = [row.number(2, "x")?, row.number(3, "y")?];
            if found.setup.fiducials.insert(mark.clone(), place).is_some() {
                return Err(Error::Duplicate {
                    kind: Thing::FiducialMark,
                    name: mark,
                    at: Place::line(row.line).with_field("mark"),
                });
            }
        }
        Some("distortion") => found.distortion.push([row.number(1, "radius")?, row.number(2, "displacement")?]),
        Some("control") => {
            let xyz = Vector3::new(row.number(2, "X")?, row.number(3, "Y")?, row.number(4, "Z")?);
            let sigma = match row.fields.len() {
                0..=5 => None,
                6 | 7 => Some([Some(positive(5, "sigma")?); 3]),
                _ => Some([Some(positive(5, "sX")?), Some(positive(6, "sY")?), Some(positive(7, "sZ")?)]),
            };
            let id = row.text(1, "point")?.to_owned();
            let point = Point { id, role: Role::Control, xyz: Some(xyz.into()), sigma, ..Point::default() };
            found.control.push(point);
        }
        _ => return Ok(false),
    }
    Ok(true)
}

#[cfg(test)]
mod tests;
