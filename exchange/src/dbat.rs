//! XML projects of the Damped Bundle Adjustment Toolbox (script version 1.0) with the text files they name.
//!
//! A file's columns are named by its `format` attribute (`id,label,x,y,z,sx,sy,sz`; `id,im,x,y,sx,sy`; `id,path`), a
//! `filter` keeps or removes points by id. Principal point and format are in millimetres from the top left corner, y
//! downwards; K and P correct the measured point (backward models), as ours do.
//! Operations other than the choice of what is estimated and the least number of rays are left to the user.

pub(super) mod element;

use crate::reason::ExchangeReason;
use std::collections::HashMap;

use element::Element;

use super::{Files, encoding, text};
use sightline::error::{Error, Place, Reason, Result, Thing, shortened};
use sightline::project::{Camera, DatumKind, Interior, Observation, Parameter, Photo, Point, Project, Role, Sigma};

/// Sigma of an image measurement in pixels where neither the file nor the project has one.
const DEFAULT_SIGMA: f64 = 1.0;

/// Reads the project; its files are found by the path in the project or by their bare names.
///
/// # Errors
/// [`Error::Invalid`] with file, line and field; [`Error::Unknown`] for a file that is named and not given.
pub fn import(files: &Files) -> Result<Project> {
    let is_project = |(name, bytes): &(&String, &Vec<u8>)| {
        name.to_ascii_lowercase().ends_with(".xml")
            || encoding::text(bytes).is_ok_and(|text| text.trim_start().starts_with("<?xml"))
    };
    let (name, bytes) = files.iter().find(is_project).ok_or_else(|| Error::Unknown {
        kind: Thing::File,
        name: "*.xml".into(),
        at: Place::default(),
    })?;
    let script = Script { name, files };
    let document = encoding::text(bytes).and_then(|text| element::parse(&text)).map_err(|error| error.in_file(name))?;
    if document.name != "document" || document.child("input").is_none() {
        return Err(script.invalid("document", ExchangeReason::NotDbat.into()));
    }
    script.project(&document)
}

/// The project's file and those given with it.
struct Script<'a> {
    name: &'a str,
    files: &'a Files,
}

/// Columns of a table, by the names of its format.
struct DbatTable {
    file: String,
    columns: HashMap<String, usize>,
    rows: Vec<text::Row>,
}

impl DbatTable {
    fn place(&self, name: &str) -> Result<usize> {
        let missing = || Error::Invalid {
            reason: ExchangeReason::NoColumn { column: name.into() }.into(),
            at: Place::field("format"),
        };
        self.columns.get(name).copied().ok_or_else(missing)
    }
}

impl Script<'_> {
    fn invalid(&self, field: &str, reason: Reason) -> Error {
        Error::Invalid { reason, at: Place::field(field).with_file(self.name) }
    }

    fn project(&self, document: &Element) -> Result<Project> {
        let input = document.child("input").ok_or_else(|| self.invalid("input", ExchangeReason::NotDbat.into()))?;
        let meta =
            |name: &str| document.child("meta").and_then(|meta| meta.child(name)).map(|element| element.text.clone());
        let mut project = Project { name: meta("name").unwrap_or_default(), ..Project::default() };
        if let Some(unit) = meta("project_unit") {
            project.unit = unit;
        }
        let estimated = self.estimated(document);
        for camera in input.child("cameras").iter().flat_map(|cameras| cameras.children("camera")) {
            let id = (project.cameras.len() + 1).to_string();
            project.cameras.push(Camera { free: estimated.clone(), ..self.camera(camera, id)? });
        }
        self.photos(input, &mut project)?;
        for (section, role) in [("ctrl_pts", Role::Control), ("check_pts", Role::Check)] {
            for section in input.children(section) {
                self.points(section, role, &mut project)?;
            }
        }
        project.datum.kind = if project.points.iter().any(|point| point.role == Role::Control) {
            DatumKind::Control
        } else {
            DatumKind::Free
        };
        for section in input.children("image_pts") {
            self.marks(section, &mut project)?;
        }
        super::name_photos_and_points(&mut project);
        self.drop_weak_points(document, &mut project)?;
        Ok(project)
    }

    /// Whether the script estimates the interior orientation: all parameters or none.
    fn estimated(&self, document: &Element) -> Vec<Parameter> {
        let choices = document.child("operations").into_iter().flat_map(|all| all.children("operation"));
        let io = choices.filter_map(|operation| operation.child("set_bundle_estimate_params")?.child("io")).next_back();
        let word = |element: &Element| element.child("all").map_or(&element.text, |all| &all.text).trim().to_owned();
        match io {
            Some(io) if matches!(word(io).as_str(), "true" | "default") => {
                use Parameter as P;
                vec![P::C, P::X0, P::Y0, P::K1, P::K2, P::K3, P::P1, P::P2]
            }
            _ => Vec::new(),
        }
    }

    fn camera(&self, camera: &Element, id: String) -> Result<Camera> {
        let numbers = |name: &str, count: usize| {
            let missing = || self.invalid(name, Reason::Missing { name: name.into() });
            let Some(element) = camera.child(name) else {
                // A missing distortion means a lens without distortion; a missing principal point is not at 0.
                return if matches!(name, "K" | "P" | "skew" | "model" | "cc") {
                    Ok(vec![0.0; count])
                } else {
                    Err(missing())
                };
            };
            let found: Option<Vec<f64>> =
                element.text.split([',', ' ']).filter(|word| !word.is_empty()).map(text::number).collect();
            let wrong = || {
                self.invalid(
                    name,
                    ExchangeReason::Numbers { name: name.into(), count, text: shortened(&element.text) }.into(),
                )
            };
            found.filter(|found| found.len() >= count).ok_or_else(wrong)
        };
        let (sensor, image, pp, p) = (numbers("sensor", 2)?, numbers("image", 2)?, numbers("pp", 2)?, numbers("P", 2)?);
        let k: Vec<f64> = numbers("K", 1)?.into_iter().chain([0.0; 3]).take(3).collect();
        let (c, model, skew) = (numbers("cc", 1)?[0], numbers("model", 1)?[0], numbers("skew", 1)?[0]);
        for (name, values) in [("sensor", &sensor), ("image", &image)] {
            if values.iter().any(|value| *value <= 0.0) {
                return Err(self.invalid(name, ExchangeReason::SizeNotPositive { name: name.into() }.into()));
            }
        }
        if model < 0.0 && k.iter().chain(&p).any(|value| *value != 0.0) {
            return Err(self.invalid("model", ExchangeReason::LensModel { model: model.into() }.into()));
        }
        if skew != 0.0 {
            return Err(self.invalid("skew", ExchangeReason::Skew.into()));
        }
        // The affinity multiplies x before the distortion: it is a matter of the pixel pitch here.
        let aspect = if camera.child("aspect").is_some() { numbers("aspect", 1)?[0] } else { 1.0 };
        // No principal distance, or 0, is one that is not known.
        for (name, wrong) in [("aspect", aspect <= 0.0), ("cc", c < 0.0)] {
            if wrong {
                return Err(self.invalid(name, ExchangeReason::SizeNotPositive { name: name.into() }.into()));
            }
        }
        let square = sensor[1] / image[1];
        let pitch = [if aspect == 1.0 { sensor[0] / image[0] } else { square * aspect }, square];
        let interior = Interior::Brown {
            c: Some(c).filter(|c| *c > 0.0),
            x0: pp[0] * aspect - pitch[0] * image[0] / 2.0,
            y0: sensor[1] / 2.0 - pp[1],
            k1: k[0],
            k2: k[1],
            k3: k[2],
            p1: p[0],
            p2: p[1],
            b1: 0.0,
            b2: 0.0,
        };
        Ok(Camera { pixel_pitch: Some(pitch), ..Camera::new(id, image[0] as u32, image[1] as u32, interior) })
    }

    fn photos(&self, input: &Element, project: &mut Project) -> Result<()> {
        for element in input.children("images").flat_map(|images| images.children("file")) {
            let table = self.table(element)?;
            let (id, path) = (table.place("id")?, table.place("path")?);
            let camera = table.columns.get("cam").or_else(|| table.columns.get("camera"));
            for row in &table.rows {
                let named = |error: Error| error.in_file(&table.file);
                let camera = match (camera, project.cameras.as_slice()) {
                    (Some(&column), _) => row.text(column, "cam").map_err(named)?.to_owned(),
                    (None, [only]) => only.id.clone(),
                    (None, cameras) => {
                        return Err(
                            self.invalid("cameras", ExchangeReason::CamerasNotTold { cameras: cameras.len() }.into())
                        );
                    }
                };
                let path = row.text(path, "path").map_err(named)?;
                project.photos.push(Photo {
                    id: row.text(id, "id").map_err(named)?.to_owned(),
                    camera,
                    file: path.rsplit(['/', '\\']).next().unwrap_or_default().to_owned(),
                    enabled: true,
                    ..Photo::default()
                });
            }
        }
        Ok(())
    }

    fn points(&self, section: &Element, role: Role, project: &mut Project) -> Result<()> {
        let mut all = Vec::new();
        for element in section.children("file") {
            let table = self.table(element)?;
            let [id, x, y, z] = [table.place("id")?, table.place("x")?, table.place("y")?, table.place("z")?];
            for row in &table.rows {
                let point = || -> Result<Point> {
                    let mut sigma = [None; 3];
                    for (value, name) in sigma.iter_mut().zip(["sx", "sy", "sz"]) {
                        let column = table.columns.get(name).filter(|column| row.fields.len() > **column);
                        *value = column.map(|&column| row.number(column, name)).transpose()?;
                    }
                    let xyz = [row.number(x, "x")?, row.number(y, "y")?, row.number(z, "z")?];
                    let sigma = sigma.iter().any(Option::is_some).then_some(sigma);
                    Ok(Point {
                        id: row.text(id, "id")?.to_owned(),
                        role,
                        xyz: Some(xyz),
                        sigma,
                        diameter: None,
                        normal: None,
                    })
                };
                all.push(point().map_err(|error| error.in_file(&table.file))?);
            }
        }
        for filter in section.children("filter") {
            let ids: Vec<&str> = filter.attribute("id").unwrap_or_default().split(',').map(str::trim).collect();
            match filter.text.trim() {
                "remove" => all.retain(|point| !ids.contains(&point.id.as_str())),
                "keep" => all.retain(|point| ids.contains(&point.id.as_str())),
                other => return Err(self.invalid("filter", ExchangeReason::Filter { text: shortened(other) }.into())),
            }
        }
        project.points.extend(all);
        Ok(())
    }

    fn marks(&self, section: &Element, project: &mut Project) -> Result<()> {
        for element in section.children("file") {
            let table = self.table(element)?;
            let [id, photo, x, y] = [table.place("id")?, table.place("im")?, table.place("x")?, table.place("y")?];
            let common = match element.attribute("sxy") {
                None => None,
                Some(word) => Some(text::number(word).filter(|sigma| *sigma > 0.0).ok_or_else(|| {
                    self.invalid("sxy", Reason::NotANumber { name: "sxy".into(), text: shortened(word) })
                })?),
            };
            for row in &table.rows {
                let mark = || -> Result<Observation> {
                    // Values of the project override those of the file.
                    let own = |name| table.columns.get(name).map(|&column| row.number(column, name)).transpose();
                    let sigma = match (common, own("sxy")?, own("sx")?, own("sy")?) {
                        (Some(sigma), ..) | (None, Some(sigma), ..) => Sigma::One(sigma),
                        (None, None, Some(sx), Some(sy)) => Sigma::Two([sx, sy]),
                        (None, None, Some(_), None) => {
                            return Err(row.invalid("sy", ExchangeReason::NoColumn { column: "sy".into() }.into()));
                        }
                        (None, None, None, Some(_)) => {
                            return Err(row.invalid("sx", ExchangeReason::NoColumn { column: "sx".into() }.into()));
                        }
                        _ => Sigma::One(DEFAULT_SIGMA),
                    };
                    let (u, v) = (row.number(x, "x")?, row.number(y, "y")?);
                    let (photo, point) = (row.text(photo, "im")?.to_owned(), row.text(id, "id")?.to_owned());
                    Ok(Observation { photo, point, u, v, sigma, enabled: true, target: None })
                };
                project.observations.push(mark().map_err(|error| error.in_file(&table.file))?);
            }
        }
        Ok(())
    }

    /// `check_ray_count`: tie points with fewer rays than asked for are not used.
    fn drop_weak_points(&self, document: &Element, project: &mut Project) -> Result<()> {
        let operations = document.child("operations").into_iter().flat_map(|all| all.children("operation"));
        let Some(word) = operations.filter_map(|operation| operation.attribute("min_rays")).next_back() else {
            return Ok(());
        };
        let least: usize = word.trim().parse().map_err(|_| {
            self.invalid("min_rays", ExchangeReason::NotWhole { name: "min_rays".into(), text: shortened(word) }.into())
        })?;
        let mut rays: HashMap<String, usize> = HashMap::new();
        for observation in &project.observations {
            *rays.entry(observation.point.clone()).or_default() += 1;
        }
        let held: std::collections::HashSet<&str> =
            project.points.iter().filter(|point| point.role != Role::Tie).map(|point| point.id.as_str()).collect();
        for observation in &mut project.observations {
            observation.enabled = rays[&observation.point] >= least || held.contains(observation.point.as_str());
        }
        Ok(())
    }

    /// The file that an element names, with the columns of its format.
    fn table(&self, element: &Element) -> Result<DbatTable> {
        let path = element.text.trim();
        let bare = |path: &str| path.rsplit(['/', '\\']).next().unwrap_or_default().to_owned();
        let file = self.files.get_key_value(path).or_else(|| {
            let mut same = self.files.iter().filter(|(name, _)| bare(name) == bare(path));
            same.next().filter(|_| same.next().is_none())
        });
        let Some((name, bytes)) = file else {
            return Err(Error::Unknown {
                kind: Thing::File,
                name: path.into(),
                at: Place::default().with_file(self.name),
            });
        };
        let format = element
            .attribute("format")
            .ok_or_else(|| self.invalid("format", ExchangeReason::ColumnsNotNamed { file: path.into() }.into()))?;
        let columns =
            format.split(',').enumerate().map(|(place, column)| (column.trim().to_ascii_lowercase(), place)).collect();
        let text = encoding::text(bytes).map_err(|error| error.in_file(name))?;
        Ok(DbatTable { file: name.clone(), columns, rows: text::rows(&text) })
    }
}

#[cfg(test)]
mod tests;
