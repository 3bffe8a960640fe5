//! The results as tables for spreadsheets: points, cameras, photos, observations, and where there are any, observations of
//! other kinds and the record of the search for gross errors. Units are in the headings; an empty
//! field is a value that does not exist. Residuals and detectable biases are given in pixels, whatever the camera's unit.

mod features;
mod given;
mod rounded;

use crate::reason::ExchangeReason;
use std::collections::HashMap;

pub use rounded::digits;

use super::Files;
use super::encoding::{Encoding, to_cp949};
use super::text::{disarmed, quoted};
use sightline::adjustment::Adjustment;
use sightline::axes::ShownAxes;
use sightline::camera::parameter_unit;
use sightline::error::{Error, Place, Result, shortened};
use sightline::project::{Camera, Parameter, Project, Role};

/// Separator of the fields.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ResultSeparator {
    /// Commas (.csv).
    Comma,
    /// Tabs (.tsv), which spreadsheets paste.
    Tab,
}

/// Writes the tables; without an adjustment, the project's own values.
///
/// # Errors
/// None today; exports are fallible as a family.
pub fn write(project: &Project, adjustment: Option<&Adjustment>, separator: ResultSeparator) -> Result<Files> {
    let extension = if separator == ResultSeparator::Comma { "csv" } else { "tsv" };
    let named =
        |(name, table): (&str, ResultTable)| (format!("{name}.{extension}"), table.text(separator).into_bytes());
    Ok(tables(project, adjustment).into_iter().map(named).collect())
}

/// The same for people: numbers to the digits of their standard errors, and in an encoding that a spreadsheet recognises, UTF-8 with a byte
/// order mark or CP949.
///
/// # Errors
/// [`ExchangeReason::CannotCarry`] with a field that CP949 cannot write.
pub fn spreadsheet(project: &Project, adjustment: Option<&Adjustment>, encoding: Encoding) -> Result<Files> {
    let written = |(name, mut table): (&str, ResultTable)| {
        rounded::round(&mut table);
        let text = table.text(ResultSeparator::Comma);
        let bytes = match encoding {
            // µ is in CP949 as the Greek letter only.
            Encoding::Cp949 => to_cp949(&text.replace('µ', "μ")).map_err(|letter| {
                let field = table.rows.iter().flatten().find(|field| field.contains(letter)).map_or("", String::as_str);
                Error::Invalid {
                    reason: ExchangeReason::CannotCarry { name: shortened(field) }.into(),
                    at: Place::default(),
                }
            })?,
            _ => ["\u{feff}".as_bytes(), text.as_bytes()].concat(),
        };
        Ok((format!("{name}.csv"), bytes))
    };
    tables(project, adjustment).into_iter().map(written).collect()
}

fn tables(project: &Project, adjustment: Option<&Adjustment>) -> Vec<(&'static str, ResultTable)> {
    let mut tables = vec![
        ("points", points(project, adjustment)),
        ("cameras", cameras(project, adjustment)),
        ("photos", photos(project, adjustment)),
        ("observations", observations(project, adjustment)),
    ];
    tables.extend(adjustment.filter(|a| !a.given.is_empty()).map(|a| ("given", given::observations(project, a))));
    let searched = adjustment.filter(|a| !a.gross_errors.is_empty());
    tables.extend(searched.map(|a| ("gross_errors", given::record(project, a))));
    tables.extend(adjustment.iter().flat_map(|a| features::tables(project, a)));
    tables
}

/// A table of text; the first row is its heading.
struct ResultTable {
    rows: Vec<Vec<String>>,
}

impl ResultTable {
    fn new<'a>(heading: impl IntoIterator<Item = &'a str>) -> Self {
        Self { rows: vec![heading.into_iter().map(str::to_owned).collect()] }
    }

    fn text(&self, separator: ResultSeparator) -> String {
        let mark = if separator == ResultSeparator::Comma { ',' } else { '\t' };
        let line = |row: &Vec<String>| {
            row.iter()
                .map(|field| quoted(&disarmed(field), mark).into_owned())
                .collect::<Vec<_>>()
                .join(&mark.to_string())
                + "\n"
        };
        self.rows.iter().map(line).collect()
    }
}

fn value(number: Option<f64>) -> String {
    number.filter(|number| number.is_finite()).map(|number| number.to_string()).unwrap_or_default()
}

fn values<const N: usize>(numbers: Option<[f64; N]>) -> [String; N] {
    numbers.map_or_else(|| std::array::from_fn(|_| String::new()), |numbers| numbers.map(|number| value(Some(number))))
}

/// Headings of coordinates and their standard errors.
fn coordinates(axes: ShownAxes, unit: &str) -> [String; 6] {
    let [a, b, c] = axes.names();
    let sigmas = [a, b, c].map(|name| format!("s{name} [{unit}]"));
    let [a, b, c] = [a, b, c].map(|name| format!("{name} [{unit}]"));
    let [sa, sb, sc] = sigmas;
    [a, b, c, sa, sb, sc]
}

fn points(project: &Project, adjustment: Option<&Adjustment>) -> ResultTable {
    let axes = project.shown_axes();
    let heading = coordinates(axes, &project.unit);
    let heading = ["id", "role"].into_iter().chain(heading.iter().map(String::as_str)).chain(["rays"]);
    let mut table = ResultTable::new(heading);
    let adjusted: HashMap<&str, _> =
        adjustment.iter().flat_map(|a| &a.points).map(|point| (point.id.as_str(), point)).collect();
    for point in &project.points {
        let role = match point.role {
            Role::Tie => "tie",
            Role::Control => "control",
            Role::Check => "check",
        };
        let mut row = vec![point.id.clone(), role.to_owned()];
        match adjusted.get(point.id.as_str()) {
            Some(found) => {
                row.extend(values(Some(axes.shown(found.xyz))));
                row.extend(values(found.sigma.map(|sigma| axes.shown(sigma))));
                row.push(found.rays.to_string());
            }
            None => {
                row.extend(values(point.xyz.map(|xyz| axes.shown(xyz))));
                row.extend(axes.shown(point.sigma.unwrap_or_default()).map(value));
                row.push(String::new());
            }
        }
        table.rows.push(row);
    }
    table
}

fn cameras(project: &Project, adjustment: Option<&Adjustment>) -> ResultTable {
    let mut table = ResultTable::new(["camera", "parameter", "unit", "value", "sigma", "estimated"]);
    for camera in &project.cameras {
        let adjusted = adjustment.iter().flat_map(|a| &a.cameras).find(|found| found.camera.id == camera.id);
        let interior = adjusted.map_or(camera.interior, |found| found.camera.interior);
        for &parameter in interior.parameters().iter().filter(|parameter| **parameter != Parameter::F) {
            let sigma = adjusted.and_then(|found| {
                let common = matches!(parameter, Parameter::Fx | Parameter::Fy).then_some(Parameter::F);
                found.sigma.get(&parameter).or_else(|| found.sigma.get(&common?)).copied()
            });
            table.rows.push(vec![
                camera.id.clone(),
                parameter.name().to_owned(),
                parameter_unit(camera, parameter),
                value(interior.get(parameter)),
                value(sigma),
                (if sigma.is_some() { "yes" } else { "no" }).to_owned(),
            ]);
        }
    }
    table
}

fn photos(project: &Project, adjustment: Option<&Adjustment>) -> ResultTable {
    let axes = project.shown_axes();
    let position = coordinates(axes, &project.unit);
    let angles = ["omega [deg]", "phi [deg]", "kappa [deg]", "s_omega [deg]", "s_phi [deg]", "s_kappa [deg]"];
    let names = position.iter().map(String::as_str);
    let mut table = ResultTable::new(["id", "file", "camera"].into_iter().chain(names).chain(angles).chain([
        "rms_x [px]",
        "rms_y [px]",
        "points",
    ]));
    let adjusted: HashMap<&str, _> =
        adjustment.iter().flat_map(|a| &a.photos).map(|photo| (photo.id.as_str(), photo)).collect();
    let scale = scales(project);
    let degrees = |angles: Option<[f64; 3]>| values(angles.map(|angles| angles.map(f64::to_degrees)));
    for photo in &project.photos {
        let mut row = vec![photo.id.clone(), photo.file.clone(), photo.camera.clone()];
        match adjusted.get(photo.id.as_str()) {
            Some(found) => {
                let [sx, sy] = scale.get(photo.id.as_str()).copied().unwrap_or([1.0; 2]);
                row.extend(values(Some(axes.shown(found.position))));
                row.extend(values(found.sigma_position.map(|sigma| axes.shown(sigma))));
                row.extend(degrees(Some(found.rotation)));
                row.extend(degrees(found.sigma_rotation));
                row.extend([value(Some(found.rms_x * sx)), value(Some(found.rms_y * sy)), found.points.to_string()]);
            }
            None => {
                row.extend(values(photo.position.map(|position| axes.shown(position))));
                row.extend(values::<3>(None));
                row.extend(degrees(photo.rotation));
                row.extend(values::<6>(None));
            }
        }
        table.rows.push(row);
    }
    table
}

/// Pixels for a photo unit, per photo and axis.
fn scales(project: &Project) -> HashMap<&str, [f64; 2]> {
    let camera = |id: &str| project.cameras.iter().find(|camera| camera.id == id);
    let scale = |camera: &Camera| camera.residual_pitch().map(|pitch| 1.0 / pitch);
    project.photos.iter().filter_map(|photo| Some((photo.id.as_str(), scale(camera(&photo.camera)?)))).collect()
}

fn observations(project: &Project, adjustment: Option<&Adjustment>) -> ResultTable {
    let effect = ["x", "y"].map(|side| format!("effect_{side} [{}]", project.unit));
    let mut table = ResultTable::new([
        "photo",
        "point",
        "u [px]",
        "v [px]",
        "sigma_u [px]",
        "sigma_v [px]",
        "vx [px]",
        "vy [px]",
        "rx",
        "ry",
        "wx",
        "wy",
        "mdb_x [px]",
        "mdb_y [px]",
        "enabled",
        &effect[0],
        &effect[1],
    ]);
    let scale = scales(project);
    // The adjustment keeps the project's order; one of another project gives no residuals.
    let adjusted = adjustment.map(|a| a.observations.as_slice()).filter(|all| all.len() == project.observations.len());
    for (index, observation) in project.observations.iter().enumerate() {
        let found = adjusted
            .map(|all| &all[index])
            .filter(|found| found.photo == observation.photo && found.point == observation.point);
        let [sx, sy] = scale.get(observation.photo.as_str()).copied().unwrap_or([1.0; 2]);
        let [su, sv] = observation.sigma.both();
        let mut row = vec![observation.photo.clone(), observation.point.clone()];
        row.extend([observation.u, observation.v, su, sv].map(|number| value(Some(number))));
        row.extend(match found {
            Some(a) => [
                value(a.vx.map(|v| v * sx)),
                value(a.vy.map(|v| v * sy)),
                value(a.rx),
                value(a.ry),
                value(a.wx),
                value(a.wy),
                value(a.mdb_x.map(|mdb| mdb * sx)),
                value(a.mdb_y.map(|mdb| mdb * sy)),
            ],
            None => std::array::from_fn(|_| String::new()),
        });
        let enabled = found.map_or(observation.enabled, |found| found.enabled);
        row.push((if enabled { "yes" } else { "no" }).to_owned());
        row.extend(found.map_or([None; 2], |a| [a.effect_x, a.effect_y]).map(value));
        table.rows.push(row);
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;
    use sightline::adjustment::{
        AdjustedCamera, AdjustedObservation, AdjustedPhoto, AdjustedPoint, Correlation, Termination,
    };
    use sightline::project::Interior;
    use sightline::project::{Observation, Photo, Point, Sigma};
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    fn small() -> (Project, Adjustment) {
        let camera = Camera {
            pixel_pitch: Some([0.01, 0.02]),
            free: vec![Parameter::C],
            ..Camera::new("c", 100, 80, Interior::brown(12.5))
        };
        let project = Project {
            cameras: vec![camera.clone()],
            photos: vec![Photo {
                id: "1".into(),
                camera: "c".into(),
                file: "a,b.jpg".into(),
                enabled: true,
                ..Photo::default()
            }]
            .into(),
            points: vec![Point { id: "7".into(), xyz: Some([1.0, 2.0, 3.0]), ..Point::default() }].into(),
            observations: vec![Observation {
                photo: "1".into(),
                point: "7".into(),
                u: 1.5,
                v: 2.25,
                sigma: Sigma::One(0.1),
                enabled: true,
                target: None,
            }]
            .into(),
            ..Project::default()
        };
        let adjustment = Adjustment {
            termination: Termination::Converged,
            iterations: Vec::new(),
            observations_count: 2,
            unknowns: 1,
            constraints: 0,
            redundancy: 1,
            sigma0: Some(1.0),
            global_test: None,
            cameras: vec![AdjustedCamera {
                camera,
                photo: None,
                sigma: [(Parameter::C, 0.125)].into(),
                significance: Default::default(),
                correlation: Correlation::default(),
            }],
            photos: vec![AdjustedPhoto {
                id: "1".into(),
                rotation: [0.0, 0.0, std::f64::consts::PI],
                rms_x: 0.01,
                ..AdjustedPhoto::default()
            }],
            points: vec![AdjustedPoint {
                id: "7".into(),
                xyz: [1.5, 2.0, 3.0],
                sigma: Some([0.5; 3]),
                covariance: None,
                rays: 1,
            }],
            observations: vec![AdjustedObservation {
                photo: "1".into(),
                point: "7".into(),
                vx: Some(0.01),
                vy: Some(0.04),
                rx: Some(0.5),
                enabled: true,
                ..Default::default()
            }],
            ..Adjustment::default()
        };
        (project, adjustment)
    }

    #[test]
    fn tables_hold_values_and_sigmas_with_units() {
        let (project, adjustment) = small();
        let files = write(&project, Some(&adjustment), ResultSeparator::Comma).unwrap();
        let text = |name: &str| String::from_utf8(files[name].clone()).unwrap();
        assert_eq!(
            text("points.csv"),
            "id,role,X [mm],Y [mm],Z [mm],sX [mm],sY [mm],sZ [mm],rays\n7,tie,1.5,2,3,0.5,0.5,0.5,1\n"
        );
        assert!(text("cameras.csv").contains("c,c,mm,12.5,0.125,yes\nc,x0,mm,0,,no\n"));
        assert!(text("photos.csv").contains("1,\"a,b.jpg\",c,0,0,0,,,,0,0,180,,,,1,0,0\n"));
        assert!(text("observations.csv").ends_with("1,7,1.5,2.25,0.1,0.1,1,2,0.5,,,,,,yes,,\n"));
        for table in files.keys() {
            let text = text(table);
            let mut reader = csv::ReaderBuilder::new().from_reader(text.as_bytes());
            assert_eq!(reader.records().filter(|record| record.is_ok()).count(), text.lines().count() - 1, "{table}");
        }
    }

    #[test]
    fn a_project_alone_and_tabs_work_too() {
        let (project, _) = small();
        let files = write(&project, None, ResultSeparator::Tab).unwrap();
        let text = |name: &str| String::from_utf8(files[name].clone()).unwrap();
        assert!(text("points.tsv").ends_with("7\ttie\t1\t2\t3\t\t\t\t\n"));
        assert!(text("photos.tsv").contains("1\ta,b.jpg\tc\t\t"));
        let columns = |text: &str| {
            text.lines().map(|line| line.split('\t').count()).collect::<std::collections::HashSet<_>>().len()
        };
        assert!(files.keys().all(|name| columns(&text(name)) == 1));
    }
}
