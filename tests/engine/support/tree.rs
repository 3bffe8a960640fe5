//! Damage to a document's JSON tree, for the tests and for the fuzz target.

use serde_json::{Value, json};

/// Damages one place: walks down at random and stops at a leaf or on the way. `below(n)` draws from 0 to n - 1.
pub fn damage(value: &mut Value, below: &mut dyn FnMut(usize) -> usize) {
    let stops = below(50) == 0;
    match value {
        Value::Array(list) if !list.is_empty() && !stops => {
            let at = below(list.len());
            damage(&mut list[at], below);
        }
        Value::Object(fields) if !fields.is_empty() && !stops => {
            let at = below(fields.len());
            if let Some((_, field)) = fields.iter_mut().nth(at) {
                damage(field, below);
            }
        }
        Value::Array(list) => match below(3) {
            0 => list.truncate(below(list.len() + 1)),
            1 => list.extend_from_within(..),
            _ => list.clear(),
        },
        _ if below(20) == 0 => {
            let kinds = [json!(null), json!(3), json!("p1"), json!(false), json!([1e9, -1e9, 1e9]), json!({})];
            *value = kinds[below(kinds.len())].clone();
        }
        // Mostly the kind stays, so that many documents are read.
        Value::Number(number) => {
            let odd = [0.0, -1.0, 1e-300, 1e300, -1e18, 3.0, 1e-9];
            let factor = below(600_001) as f64 / 100_000.0 - 3.0;
            let changed = number.as_f64().unwrap_or_default() * factor;
            let to = if below(2) == 0 { changed } else { odd[below(odd.len())] };
            *value = if number.is_f64() { json!(to) } else { json!(below(9000)) };
        }
        Value::String(text) => {
            let others = ["p1", "p3", "f1", "f2", "control", "tie", "free", "minimal", "brown", "opencv", "c", "k1"];
            *text = others[below(others.len())].into();
        }
        Value::Bool(on) => *on = !*on,
        _ => {}
    }
}

/// Whether no number in a value's debug text is NaN or infinite; identifiers may be called what they like.
pub fn is_finite(text: &str) -> bool {
    let (mut quoted, mut escaped, mut plain) = (false, false, String::with_capacity(text.len()));
    for letter in text.chars() {
        match letter {
            _ if escaped => escaped = false,
            '\\' if quoted => escaped = true,
            '"' => quoted = !quoted,
            _ if !quoted => plain.push(letter),
            _ => {}
        }
    }
    !plain.contains("NaN") && !plain.contains("inf")
}
