//! Fuzzing from seeds: documents whose JSON tree is damaged anywhere give a result or an error, in bounded time, and no
//! number that is none.

use crate::networks::{Uniform, Wanted, brown, exact, noisy, opencv};
use serde_json::{Value, json};
use sightline::adjust::adjust;
use sightline::adjustment::{AdjustOptions, Robust};
use sightline::noise::Noise;
use sightline::project::{DatumKind, Parameter, Project};
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

fn below(n: usize, random: &mut Uniform) -> usize {
    random.between(0.0, n as f64) as usize
}

/// Damages one place of the tree: walks down at random and stops at a leaf or on the way.
fn damage(value: &mut Value, random: &mut Uniform) {
    let stops = random.between(0.0, 1.0) < 0.02;
    match value {
        Value::Array(list) if !list.is_empty() && !stops => {
            let at = below(list.len(), random);
            damage(&mut list[at], random);
        }
        Value::Object(fields) if !fields.is_empty() && !stops => {
            let at = below(fields.len(), random);
            if let Some((_, field)) = fields.iter_mut().nth(at) {
                damage(field, random);
            }
        }
        Value::Array(list) => match below(3, random) {
            0 => list.truncate(below(list.len() + 1, random)),
            1 => list.extend_from_within(..),
            _ => list.clear(),
        },
        _ if below(20, random) == 0 => {
            let kinds = [json!(null), json!(3), json!("p1"), json!(false), json!([1e9, -1e9, 1e9]), json!({})];
            *value = kinds[below(kinds.len(), random)].clone();
        }
        // Mostly the kind stays, so that many documents are read.
        Value::Number(number) => {
            let odd = [0.0, -1.0, 1e-300, 1e300, -1e18, 3.0, 1e-9];
            let changed = number.as_f64().unwrap_or_default() * random.between(-3.0, 3.0);
            let to = if below(2, random) == 0 { changed } else { odd[below(odd.len(), random)] };
            *value = if number.is_f64() { json!(to) } else { json!(below(9000, random)) };
        }
        Value::String(text) => {
            let others = ["p1", "p3", "f1", "f2", "control", "tie", "free", "minimal", "brown", "opencv", "c", "k1"];
            *text = others[below(others.len(), random)].into();
        }
        Value::Bool(on) => *on = !*on,
        _ => {}
    }
}

#[test]
fn damaged_json_gives_a_result_or_an_error() {
    let cameras = vec![brown(&[Parameter::C, Parameter::K1]), opencv(&[Parameter::F])];
    let wanted = Wanted { photos: 4, points: 9, distances: (1, 0.1), control: (3, 0.1), cameras, ..Wanted::default() };
    let sound = noisy(&exact(&wanted, 29), &mut Noise::new(29, 0));
    let mut random = Uniform(1234);
    let (mut results, mut errors, mut refused) = (0, 0, 0);
    for round in 0..600 {
        let mut project = sound.clone();
        project.datum.kind = [DatumKind::Free, DatumKind::Minimal, DatumKind::Control][round % 3];
        let mut document = serde_json::to_value(&project).expect("a document");
        (0..1 + round % 5).for_each(|_| damage(&mut document, &mut random));
        let Ok(project) = serde_json::from_value::<Project>(document) else {
            refused += 1;
            continue;
        };
        let options = AdjustOptions {
            snooping: round % 7 == 0,
            robust: [None, Some(Robust::Huber), Some(Robust::Tukey)][if round % 11 == 0 { round % 3 } else { 0 }],
            ..AdjustOptions::default()
        };
        match adjust(&project, &options, &mut |_| true) {
            Ok(adjustment) => {
                let text = format!("{adjustment:?}");
                assert!(!text.contains("NaN") && !text.contains("inf"), "round {round}");
                results += 1;
            }
            Err(error) => {
                assert!(!error.to_string().is_empty() && !error.to_string().contains("NaN"), "round {round}");
                errors += 1;
            }
        }
    }
    assert!(results > 100 && errors > 50 && refused > 50, "{results} results, {errors} errors, {refused} refused");
}
