//! ISO 8601 dates as days.

/// Days since 1970-01-01 of `YYYY-MM-DD`, with `Thh:mm`, `:ss` and an offset where given; `None` for anything else.
pub fn days(text: &str) -> Option<f64> {
    let text = text.trim();
    let (date, time) = match text.split_once(['T', ' ']) {
        Some((date, time)) => (date, Some(time)),
        None => (text, None),
    };
    let [year, month, day] = numbers::<3>(date, '-', [4, 2, 2])?;
    let months = [31, if leap(year) { 29 } else { 28 }, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];
    let length = *months.get(usize::try_from(month).ok()?.checked_sub(1)?)?;
    if year == 0 || !(1..=length).contains(&day) {
        return None;
    }
    let before: i64 = months.iter().take(month as usize - 1).sum();
    let years = year - 1;
    let leaps = years / 4 - years / 100 + years / 400;
    // 719 162 days lie between 0001-01-01 and 1970-01-01.
    let whole = (years * 365 + leaps + before + day - 1 - 719_162) as f64;
    Some(whole + time.map_or(Some(0.0), seconds)? / 86_400.0)
}

fn leap(year: i64) -> bool {
    year % 4 == 0 && (year % 100 != 0 || year % 400 == 0)
}

/// Seconds of a time of day, less its offset from UTC.
fn seconds(text: &str) -> Option<f64> {
    let (time, offset) = match text.strip_suffix('Z') {
        Some(time) => (time, 0),
        None => match text.rfind(['+', '-']) {
            Some(at) => {
                let [hours, minutes] = numbers::<2>(&text[at + 1..], ':', [2, 2])?;
                let sign = if text[at..].starts_with('-') { -1 } else { 1 };
                (&text[..at], sign * (hours * 3600 + minutes * 60))
            }
            None => (text, 0),
        },
    };
    let (clock, fraction) = match time.split_once('.') {
        Some((clock, digits)) => (clock, format!("0.{digits}").parse::<f64>().ok().filter(|_| !digits.is_empty())?),
        None => (time, 0.0),
    };
    let [hours, minutes, seconds] = match clock.matches(':').count() {
        1 => {
            let [hours, minutes] = numbers::<2>(clock, ':', [2, 2])?;
            [hours, minutes, 0]
        }
        _ => numbers::<3>(clock, ':', [2, 2, 2])?,
    };
    if hours > 24 || minutes > 59 || seconds > 60 {
        return None;
    }
    Some((hours * 3600 + minutes * 60 + seconds - offset) as f64 + fraction)
}

/// Whole numbers of so many digits with a mark between them.
fn numbers<const N: usize>(text: &str, mark: char, digits: [usize; N]) -> Option<[i64; N]> {
    let mut found = [0; N];
    let mut parts = text.split(mark);
    for (value, digits) in found.iter_mut().zip(digits) {
        let part = parts.next()?;
        if part.len() != digits || !part.bytes().all(|byte| byte.is_ascii_digit()) {
            return None;
        }
        *value = part.parse().ok()?;
    }
    parts.next().is_none().then_some(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn dates_are_days() {
        for (text, expected) in [
            ("1970-01-01", 0.0),
            ("1970-01-02T12:00", 1.5),
            ("2000-02-29", 11_016.0),
            ("2026-03-14T09:30:00+09:00", 20_526.0 + 0.5 / 24.0),
            ("2026-03-14T00:30:00Z", 20_526.0 + 0.5 / 24.0),
            ("2026-03-14 00:30:00.5", 20_526.0 + 0.5 / 24.0 + 0.5 / 86_400.0),
            ("1969-12-31", -1.0),
        ] {
            let found = days(text).unwrap_or_else(|| panic!("{text}"));
            assert!((found - expected).abs() < 1e-9, "{text}: {found}");
        }
        for text in [
            "",
            "14.03.2026",
            "2026-3-14",
            "2026-02-29",
            "2026-13-01",
            "2026-01-01T",
            "2026-01-01Tx",
            "2026-01-01T10:00+9",
            "0000-01-01",
            "2026-01-01T10:61",
        ] {
            assert_eq!(days(text), None, "{text}");
        }
    }
}
