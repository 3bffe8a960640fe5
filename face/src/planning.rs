//! Sheets of targets and plans.

use js_sys::Array;
use serde::Serialize;
use wasm_bindgen::prelude::*;

use super::fault::thrown;
use super::{Thrown, value};
use sightline::Result;
use sightline::error::{Error, Place, Thing};
use sightline::project::{Form, Plan, PlanFace, Point};
use sightline::ring_code::Family;
use sightline_lab::experiments;
use sightline_plan::{Criterion, Made, MakeOptions, from_project, make, predict, suggest, targets_on};
use sightline_report::sheets::{self, AdviceOptions, BarEnds, CodeCount, Printed, SheetOptions};

/// Additional output with the files.
#[derive(Serialize)]
struct Printing<'a> {
    targets: &'a [Printed],
    bars: &'a [BarEnds],
    least_distance: Option<u32>,
    scale: [f64; 2],
    scale_sigma: f64,
    diameter: f64,
}

/// Draws sheets of targets: a PDF, an SVG a sheet, lists of what is on them.
#[wasm_bindgen(js_name = targetSheet, unchecked_return_type = "TargetSheet")]
pub fn target_sheet(#[wasm_bindgen(unchecked_optional_param_type = "SheetOptions")] options: JsValue) -> Thrown {
    let drawn = || sheets::target_sheets(&value::options::<SheetOptions>(&options, &[])?);
    drawn().map(|sheets| sheet_object(&sheets)).map_err(|error| thrown(&error))
}

fn sheet_object(sheets: &sheets::Sheets) -> JsValue {
    let object = value::write(&Printing {
        targets: &sheets.targets,
        bars: &sheets.bars,
        least_distance: sheets.least_distance,
        scale: sheets.scale,
        scale_sigma: sheets.scale_sigma,
        diameter: sheets.diameter,
    });
    let svg: Array = (0..sheets.pages.len()).filter_map(|k| sheets.svg(k)).map(|svg| JsValue::from_str(&svg)).collect();
    value::set(object.unchecked_ref(), "svg", &svg);
    let pdf = [("sheets.pdf".to_owned(), sheets.pdf())];
    let files = sheets.files().into_iter().chain(pdf).collect();
    value::set(object.unchecked_ref(), "files", &value::files_object(&files));
    object
}

/// How many codes a family has at each mutual distance, the largest first.
#[wasm_bindgen(js_name = codeCounts, unchecked_return_type = "CodeCount[]")]
pub fn code_counts(#[wasm_bindgen(unchecked_param_type = "CodeFamily")] family: JsValue) -> Thrown {
    let counted = value::read::<Family>(&family, "family").map(sheets::counts);
    counted.map(|counts: Vec<CodeCount>| value::write(&counts)).map_err(|error| thrown(&error))
}

/// Which diameter for which distance and angle.
#[wasm_bindgen(js_name = targetAdvice, unchecked_return_type = "TargetAdvice[]")]
pub fn target_advice(#[wasm_bindgen(unchecked_param_type = "TargetAdviceOptions")] options: JsValue) -> Thrown {
    let advised = || sheets::advice(&value::read::<AdviceOptions>(&options, "options")?);
    advised().map(|rows| value::write(&rows)).map_err(|error| thrown(&error))
}

/// Predicts what the photos of a plan give.
#[wasm_bindgen(js_name = plan, unchecked_return_type = "PlanPrediction")]
pub fn plan(#[wasm_bindgen(unchecked_param_type = "Plan")] plan: JsValue) -> Thrown {
    let predicted = || predict(&value::read::<Plan>(&plan, "plan")?);
    predicted().map(|prediction| value::write(&prediction)).map_err(|error| thrown(&error))
}

/// The best places for the next photo of a plan.
#[wasm_bindgen(js_name = nextPhoto, unchecked_return_type = "SuggestedPhoto[]")]
pub fn next_photo(
    #[wasm_bindgen(unchecked_param_type = "Plan")] plan: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "PlanCriterion")] criterion: JsValue,
) -> Thrown {
    let found = || {
        let absent = criterion.is_undefined() || criterion.is_null();
        let criterion = if absent { Criterion::default() } else { value::read(&criterion, "criterion")? };
        suggest(&value::read::<Plan>(&plan, "plan")?, &criterion, &mut |_, _| true)
    };
    found().map(|found| value::write(&found)).map_err(|error| thrown(&error))
}

/// Makes a plan of few photos that reaches what is wanted.
#[wasm_bindgen(js_name = makePlan, unchecked_return_type = "MadePlan")]
pub fn make_plan(
    #[wasm_bindgen(unchecked_param_type = "Plan")] plan: JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "MakePlanOptions")] options: JsValue,
) -> Thrown {
    let made = || -> Result<Made> {
        let options: MakeOptions = value::options(&options, &[])?;
        make(&value::read::<Plan>(&plan, "plan")?, &options, &mut |_, _| true)
    };
    made().map(|made| value::write(&made)).map_err(|error| thrown(&error))
}

/// Targets on a form, and the faces that hide what lies behind it.
#[wasm_bindgen(js_name = targetsOn, unchecked_return_type = "FormTargets")]
pub fn targets_on_form(#[wasm_bindgen(unchecked_param_type = "PlanForm")] form: JsValue) -> Thrown {
    #[derive(Serialize)]
    struct Targets {
        points: Vec<Point>,
        faces: Vec<PlanFace>,
    }
    let made = value::read::<Form>(&form, "form").and_then(|form| targets_on(&form));
    made.map(|(points, faces)| value::write(&Targets { points, faces })).map_err(|error| thrown(&error))
}

/// The plan of measuring a project's object again.
#[wasm_bindgen(js_name = planOfProject, unchecked_return_type = "Plan")]
pub fn plan_of_project(#[wasm_bindgen(unchecked_param_type = "Project")] project: JsValue) -> Thrown {
    let plan = value::project(&project).map(|project| from_project(&project));
    plan.map(|plan| value::write(&plan)).map_err(|error| thrown(&error))
}

/// The network of one of the papers' experiments as a plan.
#[wasm_bindgen(js_name = planExample, unchecked_return_type = "Plan")]
pub fn plan_example(
    #[wasm_bindgen(unchecked_param_type = "'kang' | 'lee-calibration' | 'lee-structure' | 'kim'")] name: JsValue,
) -> Thrown {
    let found = || {
        let name = value::text(&name, "name")?;
        let unknown = || Error::Unknown { kind: Thing::Experiment, name: name.clone(), at: Place::default() };
        experiments::plan(&name).ok_or_else(unknown)
    };
    found().map(|plan| value::write(&plan)).map_err(|error| thrown(&error))
}
