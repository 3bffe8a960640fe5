//! Foreign formats: each file converts the conventions of one program.
//!
//! | name | read | written |
//! | --- | --- | --- |
//! | `sightline` | the document as JSON | `project.json` |
//! | `package` | a project file (zip) with document, targets, photos | the same, without photos |
//! | `control-csv` | lists of points: tables (id, X, Y, Z, sigmas), Leica GSI, Sokkia SDR, JobXML, LandXML, ODM ([`lists`]) | `control.csv` |
//! | `distances` | lists of distances: from, to, length, standard error ([`lists::distances`]) | |
//! | `mark-points` | image measurements: photo, point, u, v, sigma | `marks.txt` |
//! | `photomodeler` | a text export of PhotoModeler | |
//! | `aicon` | a list of target coordinates of AICON | |
//! | `dbat` | an XML project of the Damped Bundle Adjustment Toolbox with the files it names | |
//! | `comparator` | plates: fiducial marks, distortion table, readings in millimetres | |
//! | `dxf`, `ply`, `gltf` | | `drawing.dxf` for CAD; `points.ply`, `ellipsoids.ply`, `cameras.ply`; `scene.glb` |
//! | `csv`, `tsv` | | points, cameras, photos, observations with their statistics |
//! | `spreadsheet`, `spreadsheet-cp949` | | the same to the digits of their standard errors, in UTF-8 with a mark or in CP949 |
//! | `dxf-2010`, `landxml` | | `drawing.dxf` in UTF-8 with its unit; `points.xml` |
//! | `calibration` | | parameters of cameras, standard errors, correlations: `calibration.json`, `calibration.csv` |
//! | `colmap`, `colmap-binary` | cameras, images, points of COLMAP, text or binary | the same |
//! | `metashape` | cameras, markers and scale bars of Agisoft Metashape, XML and project files | `cameras.xml`, `markers.xml` |
//! | `bal`, `bundler` | problems of "Bundle Adjustment in the Large", results of Bundler | `problem.txt`; `bundle.out`, `list.txt` |
//! | `meshroom` | scenes of AliceVision | `scene.sfm` |
//! | `nvm`, `opensfm`, `pix4d`, `realitycapture` | results of VisualSFM, OpenSfM with its tracks, cameras of Pix4D and RealityCapture | |
//! | `vstars` | points of V-STARS | `points.csv` |
//! | `opencv` | | image and object points of every photo with its camera, `calibration.yml` |
//!
//! Cameras by themselves ([`cameras`]): `opencv`, `ros`, `kalibr`, `mrcal`, `colmap`, `agisoft-lens`, `micmac`, and read only `metashape`,
//! `meshroom`. The head of each file has its conventions and where they are from; what no model of the engine has is refused by name or
//! converted with a stated difference ([`conversion`]). `docs/interchange.md` is for users.
//!
//! Numbers are written with a decimal point whatever the user's language, and no cell can arm a spreadsheet: text that would be a
//! formula gets an apostrophe before it. A format that holds a part of a project only
//! (`control-csv`, `mark-points`, `aicon`) is read as a project with that part. The report and its plots are written by the crate above,
//! `sightline-report`.

mod agisoft_lens;
pub mod aicon;
mod arrows;
mod bal;
mod bundler;
mod calibration;
pub mod cameras;
mod colmap;
pub mod comparator;
pub mod control_csv;
pub mod conversion;
pub mod dbat;
pub mod displacements;
mod dxf;
mod dxf2010;
pub mod encoding;
pub mod epochs;
pub mod foreign;
mod gltf;
mod kalibr;
mod lens;
pub mod lists;
pub mod mark_points;
mod meshroom;
mod metashape;
mod micmac;
mod mrcal;
mod network;
mod nvm;
mod opencv;
mod opensfm;
pub mod package;
pub mod photomodeler;
mod pix4d;
mod ply;
mod realitycapture;
pub mod reason;
pub mod results;
mod ros;
pub mod sorting;
mod spatial;
mod text;
mod tree;
mod vstars;

pub use network::stated;
pub use text::{Row, disarmed, pasted, quoted, rows};

use crate::reason::ExchangeReason;
use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use sightline::adjustment::Adjustment;
use sightline::error::{Error, Lack, Place, Reason, Result, Thing, shortened};
use sightline::limits;
use sightline::project::{DatumKind, Origin, Photo, Point, Project, RemovedFields};

/// Files by name.
pub type Files = BTreeMap<String, Vec<u8>>;

/// A foreign format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Format {
    /// Name in the interface.
    pub name: &'static str,
    /// Whether it is read.
    pub import: bool,
    /// Whether it is written.
    pub export: bool,
}

/// The formats.
pub const FORMATS: [Format; 31] = [
    Format { name: "sightline", import: true, export: true },
    Format { name: "package", import: true, export: true },
    Format { name: "control-csv", import: true, export: true },
    Format { name: "mark-points", import: true, export: true },
    Format { name: "distances", import: true, export: false },
    Format { name: "photomodeler", import: true, export: false },
    Format { name: "aicon", import: true, export: false },
    Format { name: "dbat", import: true, export: false },
    Format { name: "comparator", import: true, export: false },
    Format { name: "dxf", import: false, export: true },
    Format { name: "dxf-2010", import: false, export: true },
    Format { name: "landxml", import: false, export: true },
    Format { name: "ply", import: false, export: true },
    Format { name: "gltf", import: false, export: true },
    Format { name: "csv", import: false, export: true },
    Format { name: "tsv", import: false, export: true },
    Format { name: "spreadsheet", import: false, export: true },
    Format { name: "spreadsheet-cp949", import: false, export: true },
    Format { name: "calibration", import: false, export: true },
    Format { name: "colmap", import: true, export: true },
    Format { name: "colmap-binary", import: false, export: true },
    Format { name: "metashape", import: true, export: true },
    Format { name: "bal", import: true, export: true },
    Format { name: "bundler", import: true, export: true },
    Format { name: "meshroom", import: true, export: true },
    Format { name: "nvm", import: true, export: false },
    Format { name: "opensfm", import: true, export: false },
    Format { name: "pix4d", import: true, export: false },
    Format { name: "realitycapture", import: true, export: false },
    Format { name: "vstars", import: true, export: true },
    Format { name: "opencv", import: false, export: true },
];

/// Assumptions of a file reader.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FileAssumptions {
    /// Name of the file.
    pub file: String,
    /// How it was read.
    pub assumptions: Vec<control_csv::Assumption>,
}

/// Choices for what files leave open.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Choices {
    /// Of tables of control points.
    #[serde(flatten)]
    pub tables: control_csv::TableChoices,
    /// Width and height of photos by the names of their files, for formats that do not have them.
    pub sizes: BTreeMap<String, [u32; 2]>,
    /// Whether a camera model is converted where the difference is more than 1 px.
    pub convert: bool,
}

/// A project that was read, with the assumptions.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Imported {
    /// The project.
    #[serde(flatten)]
    pub project: Project,
    /// File by file, for formats that leave something open; [`control_csv::Basis::Undecided`] marks what has to be asked.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub assumptions: Vec<FileAssumptions>,
    /// The format that `auto` found, for formats of other programs' networks.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub recognised: Option<&'static str>,
    /// Cameras whose model was converted, and what that leaves.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub conversions: Vec<conversion::Conversion>,
    /// Assumptions, and contents of the files that are not imported.
    #[serde(flatten)]
    pub notes: foreign::Notes,
}

impl Imported {
    /// With the record in the project of where it comes from.
    fn with_origin(mut self, files: &Files) -> Self {
        self.project.origin = Some(Box::new(Origin {
            format: self.recognised.unwrap_or_default().to_owned(),
            files: files.keys().cloned().collect(),
            assumed: self.notes.assumed.clone(),
            ignored: self.notes.ignored.clone(),
            conversions: self.conversions.clone(),
            local_system: None,
        }));
        self
    }
}

/// Reads a project, or the part of one that the format holds.
///
/// # Errors
/// As [`import_with`].
pub fn import(format: &str, files: &Files) -> Result<Project> {
    import_with(format, files, control_csv::TableChoices::default()).map(|imported| imported.project)
}

/// The same with the assumptions, and with the caller's choices for what a table leaves open.
///
/// # Errors
/// As [`import_files`].
pub fn import_with(format: &str, files: &Files, choices: control_csv::TableChoices) -> Result<Imported> {
    import_files(format, files, &Choices { tables: choices, ..Choices::default() })
}

/// The same for any format, with all choices; `auto` recognises what can be recognised by its content.
///
/// # Errors
/// [`Error::Unknown`] for a format that is not read, [`Error::Empty`] without files, [`Error::Invalid`] with file, line
/// and field for what a file has wrong, and for a camera model that is not supported or differs too much after conversion.
pub fn import_files(format: &str, files: &Files, choices: &Choices) -> Result<Imported> {
    let format = match format {
        "auto" if files.is_empty() => return Err(Error::Empty { what: Lack::Files }),
        "auto" => recognised(files)
            .ok_or(Error::Invalid { reason: ExchangeReason::FormatUnrecognised.into(), at: Place::field("format") })?,
        named => FORMATS
            .iter()
            .find(|known| known.import && known.name == named)
            .map(|known| known.name)
            .ok_or_else(|| unknown_format(named, &[], |known| known.import))?,
    };
    if files.is_empty() {
        return Err(Error::Empty { what: Lack::Files });
    }
    let in_only = |error: Error| match only(files) {
        // Files of one network name themselves.
        Ok((name, _)) if error.place().file.is_none() => error.in_file(name),
        _ => error,
    };
    let network = match format {
        "control-csv" => return control_tables(files, &choices.tables),
        "distances" => return lists::distances::import(files, &choices.tables),
        "vstars" => {
            let mut notes = foreign::Notes::default();
            let (name, bytes) = only(files)?;
            let points = encoding::text(bytes).and_then(|text| vstars::read(&text, &mut notes));
            let project = control_project(points.map_err(|error| error.in_file(name))?);
            project.validate().map_err(|error| error.in_file(name))?;
            notes.assume(foreign::Assumed::UnitUnknown);
            let imported = Imported { project, notes, recognised: Some(format), ..Imported::default() };
            return Ok(imported.with_origin(files));
        }
        "colmap" => colmap::read(files),
        "metashape" => metashape::read(files),
        "bal" => one_text(files, bal::read),
        "bundler" => bundler::read(files),
        "nvm" => one_text(files, nvm::read),
        "opensfm" => opensfm::read(files),
        "pix4d" => one_text(files, pix4d::read),
        "realitycapture" => realitycapture::read(files, &choices.sizes),
        "meshroom" => one_text(files, |text| {
            let tree = tree::json(text)?;
            meshroom::read(&tree::Node::root(&tree))
        }),
        other => return whole(other, files).map(|project| Imported { project, ..Imported::default() }),
    };
    let imported = network.and_then(|network| network.into_imported(format, choices.convert)).map_err(in_only)?;
    Ok(imported.with_origin(files))
}

/// Recognises the format of files by their content; `None` for tables and unknown formats.
pub fn recognised(files: &Files) -> Option<&'static str> {
    if colmap::recognises(files) {
        return Some("colmap");
    }
    if comparator::recognises(files) {
        return Some("comparator");
    }
    let of = |bytes: &Vec<u8>| {
        if bytes.starts_with(b"PK\x03\x04") {
            return Some(if metashape::archive::recognises(bytes) { "metashape" } else { "package" });
        }
        let text = encoding::text(bytes).ok()?;
        let start = text.trim_start();
        if let Some(format) = by_its_head(&text) {
            return Some(format);
        }
        if realitycapture::recognises(&text) {
            return Some("realitycapture");
        }
        if start.starts_with('<') {
            let root = dbat::element::parse(&text).ok()?;
            if metashape::recognises(&root) {
                return Some("metashape");
            }
            return (root.name == "document" && root.child("input").is_some()).then_some("dbat");
        }
        if start.starts_with('{') {
            let tree = tree::json(&text).ok()?;
            let root = tree::Node::root(&tree);
            if meshroom::recognises(&root) {
                return Some("meshroom");
            }
            let own = root.get("format").is_some_and(|format| format.value == "sightline");
            return own.then_some("sightline");
        }
        if start.starts_with('[') {
            let tree = tree::json(&text).ok()?;
            return opensfm::recognises(&tree::Node::root(&tree)).then_some("opensfm");
        }
        if start.starts_with("Bundle Soln") {
            return Some("photomodeler");
        }
        bal::recognises(&text).then_some("bal")
    };
    files.values().find_map(of)
}

/// Formats that begin with words of their own.
fn by_its_head(text: &str) -> Option<&'static str> {
    match () {
        () if bundler::recognises(text) => Some("bundler"),
        () if nvm::recognises(text) => Some("nvm"),
        () if pix4d::recognises(text) => Some("pix4d"),
        () => None,
    }
}

/// Points of control tables, in the unit of the first one that names its unit.
fn control_tables(files: &Files, choices: &control_csv::TableChoices) -> Result<Imported> {
    let mut assumptions = Vec::new();
    let mut tables = Vec::new();
    let mut axes = None;
    let mut choices = choices.clone();
    for (name, bytes) in files {
        let (_, table) = lists::table(bytes, &choices).map_err(|error| error.in_file(name))?;
        assumptions.push(FileAssumptions { file: name.clone(), assumptions: table.assumptions.clone() });
        axes = axes.or(table.user_axes());
        // Lists that are read together are in one local system.
        choices.local_system = table.local_system().or(choices.local_system);
        let unit = table.unit;
        tables.push((
            unit,
            Project { points: table.into_points().map_err(|error| error.in_file(name))?.into(), ..Project::default() },
        ));
    }
    let unit = tables.iter().find_map(|(unit, _)| *unit);
    let mut points = Vec::new();
    for ((own, table), name) in tables.into_iter().zip(files.keys()) {
        let table = match (own, unit) {
            (Some(own), Some(unit)) if own != unit => {
                table.scaled(own.factor(unit)).map_err(|error| error.in_file(name))?
            }
            _ => table,
        };
        points.extend(table.points);
    }
    let mut project = control_project(points);
    project.axes = axes.or(choices.project_axes);
    if let Some(unit) = unit {
        project.unit = unit.symbol().to_owned();
    }
    if assumptions
        .iter()
        .flat_map(|one| &one.assumptions)
        .any(|a| matches!(a, control_csv::Assumption::LocalSystem { .. }))
    {
        let (format, files) = (Origin::LIST.to_owned(), files.keys().cloned().collect());
        let local_system = choices.local_system;
        project.origin = Some(Box::new(Origin { format, files, local_system, ..Origin::default() }));
    }
    Ok(Imported { project, assumptions, ..Imported::default() })
}

fn whole(format: &str, files: &Files) -> Result<Project> {
    match format {
        "sightline" => {
            let (name, bytes) = only(files)?;
            document(bytes).map_err(|error| error.in_file(name))
        }
        "package" => {
            let (name, bytes) = only(files)?;
            package::read(bytes).map(|package| package.project).map_err(|error| error.in_file(name))
        }
        "mark-points" => {
            let mut project = Project::default();
            for (name, bytes) in files {
                let marks = encoding::text(bytes).and_then(|text| mark_points::observations(&text));
                project.observations.extend(marks.map_err(|error| error.in_file(name))?);
            }
            name_photos_and_points(&mut project);
            Ok(project)
        }
        "photomodeler" => one_text(files, photomodeler::parse),
        "comparator" => comparator::import(files).map(|reduced| reduced.project),
        "aicon" => one_text(files, aicon::parse).map(control_project),
        _ => dbat::import(files),
    }
}

/// Writes a project, with the result of its adjustment where the format has a place for it.
///
/// # Errors
/// [`Error::Unknown`] for a format that is not written, [`Error::Invalid`] for an identifier that the format cannot represent.
pub fn export(format: &str, project: &Project, adjustment: Option<&Adjustment>) -> Result<Files> {
    export_with(format, project, adjustment, false)
}

/// The same; `convert` accepts that a camera differs by more than 1 px in the other program's model. Networks of other programs have
/// `interchange.json` beside them: differences of converted cameras, items that the format cannot hold, and the identifiers behind its numbers.
///
/// # Errors
/// As [`export`], and [`ExchangeReason::ConversionTooLarge`].
pub fn export_with(format: &str, project: &Project, adjustment: Option<&Adjustment>, convert: bool) -> Result<Files> {
    let network = |models: network::Models<'_>| network::OutgoingNetwork::new(project, adjustment, models, convert);
    let one = |name: &str, bytes: Vec<u8>| Files::from([(name.to_owned(), bytes)]);
    match format {
        "sightline" => Ok(one("project.json", package::json(project)?)),
        "package" => {
            let content =
                package::Package { project: project.clone(), adjustment: adjustment.cloned(), ..Default::default() };
            Ok(one("project.sightline", package::write(&content)?))
        }
        "control-csv" => {
            let text = control_csv::write(&project.points, project.shown_axes());
            let read =
                control_csv::parse(&text).into_points().map(|all| all.into_iter().map(|point| point.id).collect());
            let written = project.points.iter().filter(|point| point.xyz.is_some()).map(|point| &point.id);
            carried(written, read, Place::point)?;
            Ok(one("control.csv", text.into_bytes()))
        }
        "mark-points" => {
            let text = mark_points::write(&project.observations);
            let read = mark_points::observations(&text);
            let written = || project.observations.iter().filter(|observation| observation.enabled);
            let photos = read.clone().map(|all| all.into_iter().map(|mark| mark.photo).collect());
            carried(written().map(|observation| &observation.photo), photos, Place::photo)?;
            let points = read.map(|all| all.into_iter().map(|mark| mark.point).collect());
            carried(written().map(|observation| &observation.point), points, Place::point)?;
            Ok(one("marks.txt", text.into_bytes()))
        }
        "dxf" => Ok(one("drawing.dxf", dxf::write(project, adjustment).into_bytes())),
        "dxf-2010" => Ok(one("drawing.dxf", dxf2010::write(project, adjustment).into_bytes())),
        "landxml" => Ok(one("points.xml", lists::landxml(project, adjustment)?.into_bytes())),
        "ply" => Ok(ply::write(project, adjustment)),
        "gltf" => Ok(one("scene.glb", gltf::write(project, adjustment))),
        "csv" => results::write(project, adjustment, results::ResultSeparator::Comma),
        "tsv" => results::write(project, adjustment, results::ResultSeparator::Tab),
        "spreadsheet" => results::spreadsheet(project, adjustment, encoding::Encoding::Utf8),
        "spreadsheet-cp949" => results::spreadsheet(project, adjustment, encoding::Encoding::Cp949),
        "calibration" => calibration::write(project, adjustment),
        "colmap" => colmap::write(&network(colmap::WRITES)?, false),
        "colmap-binary" => colmap::write(&network(colmap::WRITES)?, true),
        "metashape" => metashape::write(&network::adjusted(project, adjustment), &network(metashape::WRITES)?),
        "bal" => bal::write(&mut network(bal::WRITES)?),
        "bundler" => bundler::write(&network(bundler::WRITES)?),
        "meshroom" => meshroom::write(&network(meshroom::WRITES)?),
        "vstars" => Ok(one("points.csv", vstars::write(project, adjustment)?.into_bytes())),
        "opencv" => opencv::write_points(&network::adjusted(project, adjustment), convert),
        _ => Err(unknown_export(format, &[])),
    }
}

/// The document from JSON; its format and version are examined first, so that a newer one is named as such.
pub(crate) fn document(bytes: &[u8]) -> Result<Project> {
    /// What is examined first; the rest is skipped without being kept.
    #[derive(serde::Deserialize)]
    struct Head {
        format: Option<serde_json::Value>,
        version: Option<serde_json::Value>,
    }
    let text = encoding::text(bytes)?;
    check_parsed(text.as_bytes())?;
    let head: Head = serde_json::from_str(&text).map_err(|error| Error::Invalid {
        reason: Reason::NotJson { message: shortened(&error.to_string()) },
        at: Place { line: Some(error.line()), ..Place::default() },
    })?;
    check_head(head.format.as_ref(), head.version.as_ref())?;
    let mut json = serde_json::Deserializer::from_str(&text);
    let mut project = serde_path_to_error::deserialize(&mut json).map_err(|error| Error::Invalid {
        reason: Reason::DamagedDocument { message: shortened(&error.inner().to_string()) },
        // A name that is none of those known has no place of its own: the place of the object that contains it is reported.
        at: Place::field(error.path().to_string().replace(".?", "")),
    })?;
    RemovedFields::of(&text).note_in(&mut project);
    Ok(project)
}

/// Refuses a document that would take more memory than there is, by a count of its parts.
fn check_parsed(document: &[u8]) -> Result<()> {
    if limits::parsed(document) <= limits::PARSED {
        return Ok(());
    }
    let reason = ExchangeReason::TakesTooMuch { megabytes: limits::PARSED >> 20 }.into();
    Err(Error::Invalid { reason, at: Place::default() })
}

/// Refuses to write what would be read back as something else: `ids` are those that were written, `read` those that come back.
fn carried<'a>(
    ids: impl Iterator<Item = &'a String>,
    read: Result<Vec<String>>,
    at: fn(String) -> Place,
) -> Result<()> {
    let read = read.unwrap_or_default();
    for (k, id) in ids.enumerate() {
        if read.get(k) != Some(id) {
            return Err(Error::Invalid {
                reason: ExchangeReason::CannotCarry { name: shortened(id) }.into(),
                at: at(id.clone()),
            });
        }
    }
    Ok(())
}

/// Checks the fields that tell a document of this version from anything else.
///
/// # Errors
/// [`Error::Invalid`] with the field.
pub fn check_head(format: Option<&serde_json::Value>, version: Option<&serde_json::Value>) -> Result<()> {
    use serde_json::Value;
    if format.and_then(Value::as_str) != Some("sightline") {
        return Err(Error::Invalid { reason: ExchangeReason::NotADocument.into(), at: Place::field("format") });
    }
    let reason = match version {
        Some(Value::Number(version)) if version.as_f64() == Some(1.0) => return Ok(()),
        Some(Value::Number(other)) => ExchangeReason::NewerVersion { version: other.to_string() }.into(),
        Some(Value::String(other)) => ExchangeReason::NewerVersion { version: shortened(other) }.into(),
        _ => ExchangeReason::NoVersion.into(),
    };
    Err(Error::Invalid { reason, at: Place::field("version") })
}

/// Message about a format that is not supported: the names of those that are, here and, as `more`, by a crate above.
pub fn unknown_export(format: &str, more: &[&str]) -> Error {
    unknown_format(format, more, |known| known.export)
}

fn unknown_format(format: &str, more: &[&str], wanted: fn(&Format) -> bool) -> Error {
    let here = FORMATS.iter().filter(|known| wanted(known)).map(|known| known.name);
    let known: Vec<&str> = here.chain(more.iter().copied()).collect();
    Error::Unknown {
        kind: Thing::Format,
        name: format.into(),
        at: Place::field(format!("format: one of {}", known.join(", "))),
    }
}

fn only(files: &Files) -> Result<(&String, &Vec<u8>)> {
    let mut all = files.iter();
    match (all.next(), all.next()) {
        (Some(file), None) => Ok(file),
        _ => {
            Err(Error::Invalid { reason: ExchangeReason::OneFile { given: files.len() }.into(), at: Place::default() })
        }
    }
}

fn one_text<T>(files: &Files, parse: impl FnOnce(&str) -> Result<T>) -> Result<T> {
    let (name, bytes) = only(files)?;
    encoding::text(bytes).and_then(|text| parse(&text)).map_err(|error| error.in_file(name))
}

fn control_project(points: Vec<Point>) -> Project {
    let mut project = Project { points: points.into(), ..Project::default() };
    project.datum.kind = DatumKind::Control;
    project
}

/// Adds the photos and points that observations name and the project lacks, in the order of their first appearance.
fn name_photos_and_points(project: &mut Project) {
    let mut photos: std::collections::HashSet<&str> = project.photos.iter().map(|photo| photo.id.as_str()).collect();
    let mut points: std::collections::HashSet<&str> = project.points.iter().map(|point| point.id.as_str()).collect();
    let (mut new_photos, mut new_points) = (Vec::new(), Vec::new());
    for observation in &project.observations {
        if photos.insert(&observation.photo) {
            new_photos.push(Photo { id: observation.photo.clone(), enabled: true, ..Photo::default() });
        }
        if points.insert(&observation.point) {
            new_points.push(Point { id: observation.point.clone(), ..Point::default() });
        }
    }
    project.photos.extend(new_photos);
    project.points.extend(new_points);
}
