//! The JavaScript face: the engine's functions on plain objects and bytes. Nothing is computed here.
//!
//! What crosses the border has the field names of the document ([`sightline::project`]) and of the results
//! ([`sightline::adjustment`], [`sightline::detection`]); `sightline.d.ts` declares them. Arguments of a wrong kind and unknown options are
//! errors that name the field. Errors are thrown as Error with `code`, `message`, `where` and `data`.

mod calibrating;
mod codecs;
mod epochs;
mod fault;
mod photos;
mod plain;
mod planning;
mod stepping;
mod table;
mod value;

use serde::Serialize;
use wasm_bindgen::prelude::*;

use fault::thrown;
use sightline::adjustment::{AdjustOptions, Iteration};
use sightline::calibration::{CrossOptions, DifferenceOptions, ModelsOptions, UncertaintyOptions};
use sightline::monitoring::{self, Epoch};
use sightline::project::{Camera, GivenPoint};
use sightline::{Error, adjust, calibration, features, matching, orient, plausibility};
use sightline_exchange as exchange;
use sightline_exchange::foreign::CameraOptions;
use sightline_lab::experiments;
use sightline_lab::experiments::ExperimentOptions;
use sightline_plan::network;
use sightline_plan::network::Network;
use sightline_report::files;

#[wasm_bindgen(typescript_custom_section)]
const DECLARATIONS: &str = include_str!("sightline.d.ts");

type Thrown<T = JsValue> = Result<T, JsValue>;

/// Runs when the module starts.
#[wasm_bindgen(start)]
pub fn start() {
    fault::throw_panics();
}

/// Version of the engine.
#[wasm_bindgen]
pub fn version() -> String {
    env!("CARGO_PKG_VERSION").into()
}

/// Names coded targets after their codes and gathers their measurements; doubtful ones are listed, not used. Codes are of
/// the family that alone explains all rings, or of the one in `options.family`.
#[wasm_bindgen(js_name = nameCoded, unchecked_return_type = "Coded")]
pub fn name_coded(
    #[wasm_bindgen(unchecked_param_type = "PhotoTargets[]")] photos: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "NameCodedOptions")] options: JsValue,
) -> Thrown {
    #[derive(Default, Serialize, serde::Deserialize)]
    #[serde(default)]
    struct Options {
        family: Option<sightline::ring_code::Family>,
    }
    let named = || {
        let photos = value::read::<Vec<matching::PhotoTargets>>(&photos, "photos")?;
        let Options { family } = value::options(&options, &[])?;
        Ok(matching::name_coded(&photos, family))
    };
    named().map(|coded| value::write(&coded)).map_err(|error: Error| thrown(&error))
}

/// The codes of a family, those with the largest mutual distance first: numbers, and how many of the first have which distance.
#[wasm_bindgen(js_name = spreadCodes, unchecked_return_type = "CodeSpread")]
pub fn spread_codes(#[wasm_bindgen(unchecked_param_type = "CodeFamily")] family: JsValue) -> Thrown {
    #[derive(Serialize)]
    struct Spread {
        numbers: Vec<u32>,
        counts: Vec<Count>,
    }
    #[derive(Serialize)]
    struct Count {
        distance: u32,
        codes: usize,
    }
    let family = value::read::<sightline::ring_code::Family>(&family, "family");
    let spread = family.map(|family| {
        let sightline::ring_code::CodesByDistance { numbers, counts } = sightline::ring_code::spread(family);
        let counts = counts.into_iter().map(|(distance, codes)| Count { distance, codes }).collect();
        value::write(&Spread { numbers, counts })
    });
    spread.map_err(|error| thrown(&error))
}

/// Moves approximate marks of an earlier measurement onto the targets that were found within a radius in pixels.
#[wasm_bindgen(js_name = snapMarks, unchecked_return_type = "Snapped")]
pub fn snap_marks(
    #[wasm_bindgen(unchecked_param_type = "Mark[]")] marks: JsValue,
    #[wasm_bindgen(unchecked_param_type = "PhotoTargets[]")] photos: JsValue,
    #[wasm_bindgen(unchecked_param_type = "number")] radius: JsValue,
) -> Thrown {
    let snapped = || {
        let (marks, photos) = (value::read::<Vec<_>>(&marks, "marks")?, value::read::<Vec<_>>(&photos, "photos")?);
        Ok(matching::snap(&marks, &photos, value::number(&radius, "radius")?))
    };
    snapped().map(|snapped| value::write(&snapped)).map_err(|error: Error| thrown(&error))
}

/// Names the dots of a board of circles in photos, of which it takes no orientation: points, observations, and why a photo has none.
#[wasm_bindgen(js_name = nameGrid, unchecked_return_type = "GridNaming")]
pub fn name_grid(
    #[wasm_bindgen(unchecked_param_type = "Project")] project: JsValue,
    #[wasm_bindgen(unchecked_param_type = "PhotoTargets[]")] photos: JsValue,
    #[wasm_bindgen(unchecked_param_type = "Board")] board: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "GridOptions")] options: JsValue,
) -> Thrown {
    let named = || {
        let options: matching::GridOptions = value::options(&options, &[])?;
        let photos = value::read::<Vec<matching::PhotoTargets>>(&photos, "photos")?;
        let board = value::read::<matching::Board>(&board, "board")?;
        matching::name_grid(&value::project(&project)?, &photos, &board, &options)
    };
    named().map(|naming| value::write(&naming)).map_err(|error| thrown(&error))
}

/// Matches targets of oriented photos that have no name yet: to points that are there, and to new ones.
#[wasm_bindgen(js_name = matchUncoded, unchecked_return_type = "Matching")]
pub fn match_uncoded(
    #[wasm_bindgen(unchecked_param_type = "Project")] project: JsValue,
    #[wasm_bindgen(unchecked_param_type = "PhotoTargets[]")] photos: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "MatchOptions")] options: JsValue,
) -> Thrown {
    let matched = || {
        let options: matching::MatchOptions = value::options(&options, &[])?;
        let photos = value::read::<Vec<matching::PhotoTargets>>(&photos, "photos")?;
        matching::match_uncoded(&value::project(&project)?, &photos, &options)
    };
    matched().map(|matching| value::write(&matching)).map_err(|error| thrown(&error))
}

/// Predicts where a point should be in every oriented photo: epipolar lines, places and their covariances.
#[wasm_bindgen(js_name = predict, unchecked_return_type = "Prediction")]
pub fn predict_point(
    #[wasm_bindgen(unchecked_param_type = "Project")] project: JsValue,
    #[wasm_bindgen(unchecked_param_type = "string")] point: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "Adjustment | null")] adjustment: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "PredictOptions")] options: JsValue,
) -> Thrown {
    let predicted = || {
        let options: matching::PredictOptions = value::options(&options, &[])?;
        let absent = adjustment.is_undefined() || adjustment.is_null();
        let adjustment = if absent { None } else { Some(value::read(&adjustment, "adjustment")?) };
        matching::predict(&value::project(&project)?, adjustment.as_ref(), &value::text(&point, "point")?, &options)
    };
    predicted().map(|prediction| value::write(&prediction)).map_err(|error: Error| thrown(&error))
}

/// Fills in every initial value that can be found; the project comes back with `notes` on what was assumed and what could not be
/// found.
#[wasm_bindgen(js_name = orient, unchecked_return_type = "OrientedProject")]
pub fn orient_project(#[wasm_bindgen(unchecked_param_type = "Project")] project: JsValue) -> Thrown {
    let oriented = value::project(&project).and_then(|project| orient::orient(&project));
    oriented.map(value::oriented_object).map_err(|error| thrown(&error))
}

/// The project with two axes of everything given in the object's system exchanged, or one with the other sign; orientations and tie points
/// become null. What `orient` and `adjust` propose as `mirrored_control`.
#[wasm_bindgen(js_name = exchangeAxes, unchecked_return_type = "Project")]
pub fn exchange_axes(
    #[wasm_bindgen(unchecked_param_type = "Project")] project: JsValue,
    #[wasm_bindgen(unchecked_param_type = "Exchange")] exchange: JsValue,
) -> Thrown {
    let exchanged = || {
        let exchange = value::read(&exchange, "exchange")?;
        Ok(plausibility::exchange_axes(&value::project(&project)?, exchange))
    };
    exchanged().map(value::project_object).map_err(|error: Error| thrown(&error))
}

/// Adjusts the project; every iteration is shown to `options.on_iteration`, which stops the work by returning false.
#[wasm_bindgen(js_name = adjust, unchecked_return_type = "Adjustment")]
pub fn adjust_project(
    #[wasm_bindgen(unchecked_param_type = "Project")] project: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "AdjustOptions")] options: JsValue,
) -> Thrown {
    let mut exception = None;
    let mut adjusted = || {
        let callback = value::callback(&options, "on_iteration")?;
        let options: AdjustOptions = value::options(&options, &["on_iteration"])?;
        let mut goes_on = |iteration: &Iteration| {
            let Some(callback) = &callback else { return true };
            match callback.call1(&JsValue::NULL, &value::write(iteration)) {
                Ok(answer) => answer.as_bool() != Some(false),
                Err(error) => {
                    exception = Some(error);
                    false
                }
            }
        };
        adjust::adjust(&value::project(&project)?, &options, &mut goes_on)
    };
    let adjusted = adjusted();
    // What the caller's own function throws is the caller's.
    match exception {
        Some(error) => Err(error),
        None => adjusted.map(value::adjustment_object).map_err(|error| thrown(&error)),
    }
}

/// The linearised observation equations of a project at its present values.
#[wasm_bindgen(unchecked_return_type = "LinearSystem")]
pub fn linearise(
    #[wasm_bindgen(unchecked_param_type = "Project")] project: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "AdjustOptions")] options: JsValue,
) -> Thrown {
    let found = || adjust::linearise(&value::project(&project)?, &value::options(&options, &[])?);
    found().map(|system| value::write(&system)).map_err(|error| thrown(&error))
}

/// The normal equations of a project at its present values, before and after the points are eliminated.
#[wasm_bindgen(js_name = normalEquations, unchecked_return_type = "NormalEquations")]
pub fn normal_equations(
    #[wasm_bindgen(unchecked_param_type = "Project")] project: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "AdjustOptions")] options: JsValue,
) -> Thrown {
    let found = || adjust::normal_equations(&value::project(&project)?, &value::options(&options, &[])?);
    found().map(|equations| value::write(&equations)).map_err(|error| thrown(&error))
}

/// A matrix of [`linearise`] or [`normal_equations`] in the Matrix Market format.
#[wasm_bindgen(js_name = matrixMarket)]
pub fn matrix_market(
    #[wasm_bindgen(unchecked_param_type = "SparseMatrix")] matrix: JsValue,
) -> Result<String, JsValue> {
    let matrix: sightline::Result<adjust::SparseMatrix> = value::read(&matrix, "matrix");
    matrix.map(|matrix| matrix.matrix_market()).map_err(|error| thrown(&error))
}

/// Begins an adjustment at the project's values, to be run step by step.
#[wasm_bindgen(js_name = startAdjustment, unchecked_return_type = "Adjuster")]
pub fn start_adjustment(
    #[wasm_bindgen(unchecked_param_type = "Project")] project: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "AdjustOptions")] options: JsValue,
) -> Thrown {
    let begun = || adjust::start_adjustment(&value::project(&project)?, &value::options(&options, &[])?);
    begun().map(stepping::object).map_err(|error| thrown(&error))
}

/// The project with the adjusted values as new initial values; what is given stays as given.
#[wasm_bindgen(js_name = applyAdjustment, unchecked_return_type = "Project")]
pub fn apply_adjustment(
    #[wasm_bindgen(unchecked_param_type = "Project")] project: JsValue,
    #[wasm_bindgen(unchecked_param_type = "Adjustment")] adjustment: JsValue,
) -> Thrown {
    let applied = || Ok(adjust::apply(&value::project(&project)?, &value::read(&adjustment, "adjustment")?));
    applied().map(value::project_object).map_err(|error: Error| thrown(&error))
}

/// Measures the project's features and coordinate systems on an adjustment of it that was made before they were there.
#[wasm_bindgen(js_name = measureFeatures, unchecked_return_type = "Measured")]
pub fn measure_features(
    #[wasm_bindgen(unchecked_param_type = "Project")] project: JsValue,
    #[wasm_bindgen(unchecked_param_type = "Adjustment")] adjustment: JsValue,
) -> Thrown {
    let measured = || adjust::measured(&value::project(&project)?, &value::read(&adjustment, "adjustment")?);
    measured().map(|measured| value::write(&measured)).map_err(|error: Error| thrown(&error))
}

/// Standard errors of the pixels at which a calibrated camera sees directions, or points at a distance.
#[wasm_bindgen(js_name = projectionUncertainty, unchecked_return_type = "ProjectionUncertainty")]
pub fn projection_uncertainty(
    #[wasm_bindgen(unchecked_param_type = "Project")] project: JsValue,
    #[wasm_bindgen(unchecked_param_type = "Adjustment")] adjustment: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "UncertaintyOptions")] options: JsValue,
) -> Thrown {
    let found = || {
        let asked: UncertaintyOptions = value::options(&options, &[])?;
        let (project, adjustment) = (value::project(&project)?, value::read(&adjustment, "adjustment")?);
        calibration::projection_uncertainty(&project, &adjustment, &asked)
    };
    found().map(|found| value::write(&found)).map_err(|error: Error| thrown(&error))
}

/// How far two calibrations of one lens differ, after the motion that brings them together best.
#[wasm_bindgen(js_name = compareCameras, unchecked_return_type = "CameraDifference")]
pub fn compare_cameras(
    #[wasm_bindgen(unchecked_param_type = "Camera")] a: JsValue,
    #[wasm_bindgen(unchecked_param_type = "Camera")] b: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "DifferenceOptions")] options: JsValue,
) -> Thrown {
    let found = || {
        let asked: DifferenceOptions = value::options(&options, &[])?;
        let (a, b): (Camera, Camera) = (value::read(&a, "a")?, value::read(&b, "b")?);
        calibration::compare_cameras(&a, &b, &asked)
    };
    found().map(|found| value::write(&found)).map_err(|error: Error| thrown(&error))
}

/// Splits the photos, calibrates the camera from each part, and compares the parts with what their standard errors allow.
#[wasm_bindgen(js_name = crossValidate, unchecked_return_type = "CrossValidation")]
pub fn cross_validate(
    #[wasm_bindgen(unchecked_param_type = "Project")] project: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "CrossOptions")] options: JsValue,
) -> Thrown {
    let found = || {
        let asked: CrossOptions = value::options(&options, &[])?;
        calibration::cross_validate(&value::project(&project)?, &asked)
    };
    found().map(|found| value::write(&found)).map_err(|error: Error| thrown(&error))
}

/// Adjusts the project with every camera model and compares them.
#[wasm_bindgen(js_name = compareModels, unchecked_return_type = "ComparedModel[]")]
pub fn compare_models(
    #[wasm_bindgen(unchecked_param_type = "Project")] project: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "ModelsOptions")] options: JsValue,
) -> Thrown {
    let found = || {
        let asked: ModelsOptions = value::options(&options, &[])?;
        calibration::compare_models(&value::project(&project)?, &asked)
    };
    found().map(|found| value::write(&found)).map_err(|error: Error| thrown(&error))
}

/// The project with a camera in another model, its values fitted over the picture.
#[wasm_bindgen(js_name = convertCamera, unchecked_return_type = "ConvertedCamera")]
pub fn convert_camera(
    #[wasm_bindgen(unchecked_param_type = "Project")] project: JsValue,
    #[wasm_bindgen(unchecked_param_type = "string")] camera: JsValue,
    #[wasm_bindgen(unchecked_param_type = "CameraModelName")] model: JsValue,
) -> Thrown {
    let converted = || {
        let (camera, model): (String, String) = (value::read(&camera, "camera")?, value::read(&model, "model")?);
        calibration::convert_camera(&value::project(&project)?, &camera, &model)
    };
    converted().map(|(project, left)| value::converted_object(project, &left)).map_err(|error: Error| thrown(&error))
}

/// Compares epochs of one object: what has moved, by how much, and with which tests.
#[wasm_bindgen(js_name = compareEpochs, unchecked_return_type = "Monitoring")]
pub fn compare_epochs(#[wasm_bindgen(unchecked_param_type = "CompareOptions")] request: JsValue) -> Thrown {
    let compared = || {
        let epochs: Vec<Epoch> = value::read(&plain::field(&request, "epochs")?, "epochs")?;
        let options: monitoring::Options = value::options(&request, &["epochs"])?;
        monitoring::compare_epochs(&epochs, &options)
    };
    compared().map(|found| value::write(&found)).map_err(|error: Error| thrown(&error))
}

/// Reads a coordinate list with standard errors (id, X, Y, Z, sX, sY, sZ): the `points` of an epoch.
#[wasm_bindgen(js_name = readCoordinates, unchecked_return_type = "CoordinateList")]
pub fn read_coordinates(
    #[wasm_bindgen(unchecked_param_type = "Uint8Array | ArrayBuffer | string")] text: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "ImportChoices | null")] choices: JsValue,
) -> Thrown {
    let read = || exchange::epochs::points(&text_of(&text)?, value::options(&choices, &[])?);
    read().map(|list| value::write(&list)).map_err(|error: Error| thrown(&error))
}

/// Reads a list of points in any of the formats that are recognised, with all that is known of how it was read; nothing that has to be asked is guessed.
#[wasm_bindgen(js_name = readList, unchecked_return_type = "PointList")]
pub fn read_list(
    #[wasm_bindgen(unchecked_param_type = "Uint8Array | ArrayBuffer | string")] list: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "ListChoices | null")] choices: JsValue,
) -> Thrown {
    let read = || {
        let mut choices: exchange::control_csv::TableChoices = value::options(&choices, &[])?;
        let bytes = match list.as_string() {
            Some(text) => {
                // The characters are known.
                choices.encoding = Some(exchange::encoding::Encoding::Utf8);
                text.into_bytes()
            }
            None => plain::bytes(&list, "list")?,
        };
        exchange::lists::read(&bytes, &choices)
    };
    read().map(|list| value::write(&list)).map_err(|error: Error| thrown(&error))
}

/// Reads a covariance matrix as text, in full or as its lower triangle: the `covariance` of an epoch.
#[wasm_bindgen(js_name = readCovariance, unchecked_return_type = "ListedCovariance")]
pub fn read_covariance(
    #[wasm_bindgen(unchecked_param_type = "Uint8Array | ArrayBuffer | string")] text: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "(string | number)[]")] points: JsValue,
) -> Thrown {
    let read = || {
        let absent = points.is_undefined() || points.is_null();
        let names: Vec<String> = if absent { Vec::new() } else { value::identifiers(&points, "points")? };
        exchange::epochs::covariance(&text_of(&text)?, &names)
    };
    read().map(|matrix| value::write(&matrix)).map_err(|error: Error| thrown(&error))
}

/// Text, or bytes of a text file in any encoding that is read.
fn text_of(text: &JsValue) -> sightline::Result<String> {
    match text.as_string() {
        Some(text) => Ok(text),
        None => exchange::encoding::text(&plain::bytes(text, "text")?),
    }
}

/// Pairs given coordinates with the one point within `radius` of each; points and coordinates in one system.
#[wasm_bindgen(js_name = nearestNames, unchecked_return_type = "Renaming")]
pub fn nearest_names(
    #[wasm_bindgen(unchecked_param_type = "{ id: string; xyz: [number, number, number] }[]")] points: JsValue,
    #[wasm_bindgen(unchecked_param_type = "GivenPoint[]")] given: JsValue,
    #[wasm_bindgen(unchecked_param_type = "number")] radius: JsValue,
) -> Thrown {
    let found = || {
        let points = value::read::<Vec<GivenPoint>>(&points, "points")?;
        let given = value::read::<Vec<GivenPoint>>(&given, "given")?;
        let points: Vec<_> = points.into_iter().map(|p| (p.id, p.xyz)).collect();
        Ok(features::names::nearest(&points, &given, value::number(&radius, "radius")?))
    };
    found().map(|renaming| value::write(&renaming)).map_err(|error: Error| thrown(&error))
}

/// Computes what a network on paper would give: a project with its observations, exact, noisy or measured in rendered photos.
#[wasm_bindgen(unchecked_return_type = "Project")]
pub fn simulate(#[wasm_bindgen(unchecked_param_type = "Network")] network: JsValue) -> Thrown {
    let simulated = || network::simulate(&value::read::<Network>(&network, "")?);
    simulated().map(value::project_object).map_err(|error| thrown(&error))
}

/// Renders one photo of a network: a grey picture, row by row, for `detectGray` or for looking at.
#[wasm_bindgen(js_name = renderPhoto, unchecked_return_type = "Picture")]
pub fn render_photo(
    #[wasm_bindgen(unchecked_param_type = "Network")] network: JsValue,
    #[wasm_bindgen(unchecked_param_type = "string")] station: JsValue,
) -> Thrown {
    let rendered = || network::photo(&value::read::<Network>(&network, "")?, &value::text(&station, "station")?);
    rendered().map(|grey| value::picture(&grey)).map_err(|error| thrown(&error))
}

/// Runs one of the papers' experiments; each step is shown to `options.on_progress(done, of)`, which stops it by returning false.
#[wasm_bindgen(js_name = runExperiment, unchecked_return_type = "Experiment")]
pub fn run_experiment(
    #[wasm_bindgen(unchecked_param_type = "ExperimentName")] name: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "ExperimentOptions")] options: JsValue,
) -> Thrown {
    let mut exception = None;
    let mut ran = || {
        let callback = value::callback(&options, "on_progress")?;
        let chosen: ExperimentOptions = value::options(&options, &["on_progress"])?;
        let mut goes_on = |done: usize, of: usize| {
            let Some(callback) = &callback else { return true };
            match callback.call2(&JsValue::NULL, &JsValue::from(done as f64), &JsValue::from(of as f64)) {
                Ok(answer) => answer.as_bool() != Some(false),
                Err(error) => {
                    exception = Some(error);
                    false
                }
            }
        };
        experiments::run(&value::text(&name, "name")?, &chosen, &mut goes_on)
    };
    let ran = ran();
    match exception {
        Some(error) => Err(error),
        None => ran.map(|experiment| value::write(&experiment)).map_err(|error| thrown(&error)),
    }
}

/// The CSV files of an experiment: its figures, tables and charts, with every digit.
#[wasm_bindgen(js_name = experimentCsv, unchecked_return_type = "Record<string, Uint8Array>")]
pub fn experiment_csv(#[wasm_bindgen(unchecked_param_type = "Experiment")] experiment: JsValue) -> Thrown {
    let experiment = value::read::<experiments::Experiment>(&experiment, "experiment");
    experiment.map(|e| value::files_object(&experiments::csv(&e))).map_err(|error| thrown(&error))
}

/// Reads files of a foreign format as a project, or as the part of one that the format holds, with the assumptions.
#[wasm_bindgen(js_name = importProject, unchecked_return_type = "Imported")]
pub fn import_project(
    #[wasm_bindgen(unchecked_param_type = "ImportFormat")] format: JsValue,
    #[wasm_bindgen(unchecked_param_type = "Record<string, Uint8Array | ArrayBuffer | string>")] files: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "ImportChoices | null")] choices: JsValue,
) -> Thrown {
    let read = || {
        let choices = value::options(&choices, &[])?;
        exchange::import_files(&value::text(&format, "format")?, &value::files(&files)?, &choices)
    };
    read().map(value::imported_object).map_err(|error| thrown(&error))
}

/// Carries plates onto their fiducial marks: files of the format `comparator`, with every fit on the way.
#[wasm_bindgen(js_name = reduceFilm, unchecked_return_type = "ReducedFilm")]
pub fn reduce_film(
    #[wasm_bindgen(unchecked_param_type = "Record<string, Uint8Array | ArrayBuffer | string>")] files: JsValue,
) -> Thrown {
    let reduced = value::files(&files).and_then(|files| exchange::comparator::import(&files));
    reduced.map(|reduced| value::write(&reduced)).map_err(|error| thrown(&error))
}

/// Writes a project in a foreign format, with the results of its adjustment where the format has a place for them.
#[wasm_bindgen(js_name = exportProject, unchecked_return_type = "Record<string, Uint8Array>")]
pub fn export_project(
    #[wasm_bindgen(unchecked_param_type = "ExportFormat")] format: JsValue,
    #[wasm_bindgen(unchecked_param_type = "Project")] project: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "Adjustment | null")] adjustment: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "ExportOptions | null")] options: JsValue,
) -> Thrown {
    #[derive(Default, Serialize, serde::Deserialize)]
    #[serde(default)]
    struct Options {
        convert: bool,
    }
    let written = || {
        let Options { convert } = value::options(&options, &[])?;
        let project = value::project(&project)?;
        let absent = adjustment.is_undefined() || adjustment.is_null();
        let adjustment = if absent { None } else { Some(value::read(&adjustment, "adjustment")?) };
        files::export(&value::text(&format, "format")?, &project, adjustment.as_ref(), convert)
    };
    written().map(|files| value::files_object(&files)).map_err(|error: Error| thrown(&error))
}

/// Reads cameras of other programs; a model that is not one of the document's is converted, with the difference that remains.
#[wasm_bindgen(js_name = importCamera, unchecked_return_type = "ImportedCameras")]
pub fn import_camera(
    #[wasm_bindgen(unchecked_param_type = "CameraImportFormat")] format: JsValue,
    #[wasm_bindgen(unchecked_param_type = "Record<string, Uint8Array | ArrayBuffer | string>")] files: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "CameraImportOptions | null")] options: JsValue,
) -> Thrown {
    #[derive(Default, Serialize, serde::Deserialize)]
    #[serde(default)]
    struct Options {
        region: Option<Vec<[f64; 2]>>,
        convert: bool,
    }
    let read = || {
        let Options { region, convert } = value::options(&options, &[])?;
        let options = CameraOptions { region, convert, covariance: None };
        exchange::cameras::import(&value::text(&format, "format")?, &value::files(&files)?, &options)
    };
    read().map(|read| value::write(&read)).map_err(|error: Error| thrown(&error))
}

/// Writes a camera for another program, with the difference that the conversion of its model leaves.
#[wasm_bindgen(js_name = exportCamera, unchecked_return_type = "ExportedCamera")]
pub fn export_camera(
    #[wasm_bindgen(unchecked_param_type = "CameraExportFormat")] format: JsValue,
    #[wasm_bindgen(unchecked_param_type = "Camera")] camera: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "CameraExportOptions | null")] options: JsValue,
) -> Thrown {
    #[derive(Serialize)]
    struct Rest {
        conversion: Option<exchange::conversion::Conversion>,
        covariance: Option<exchange::conversion::Covariance>,
        ignored: Vec<exchange::foreign::Ignored>,
    }
    let written = || {
        let options: CameraOptions = value::options(&options, &[])?;
        let camera: Camera = value::read(&camera, "camera")?;
        exchange::cameras::export(&value::text(&format, "format")?, &camera, &options)
    };
    let object = |written: exchange::foreign::ExportedCamera| {
        let exchange::foreign::ExportedCamera { files, conversion, covariance, ignored } = written;
        let object = value::write(&Rest { conversion, covariance, ignored });
        value::set(object.unchecked_ref(), "files", &value::files_object(&files));
        object
    };
    written().map(object).map_err(|error: Error| thrown(&error))
}
