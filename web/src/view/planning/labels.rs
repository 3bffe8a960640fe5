//! Positions of station numbers in a drawing without overlaps: stations at one position share a line, and a number without
//! space next to its station is placed farther away, with a thin line to it.

use super::frame::{HEIGHT, WIDTH};

/// A station's sign as it is drawn.
#[derive(Clone, Debug)]
pub struct Sign {
    pub at: [f64; 2],
    /// Unit vector away from what it looks at, or down where it is seen end on.
    pub back: [f64; 2],
    pub id: String,
}

/// Label of one or several stations: the text, the middle of its base line, and the end of its leader if it is not beside the station.
#[derive(Clone, Debug, PartialEq)]
pub struct StationLabel {
    pub at: [f64; 2],
    pub text: String,
    /// Places of the signs it is for, in the list that was given.
    pub of: Vec<usize>,
    pub leader: Option<[f64; 2]>,
}

/// Signs closer to each other than this, in units of the drawing, are one place.
const ONE_PLACE: f64 = 6.0;
/// Numbers, or ranges of them, that a label has at most.
const MOST: usize = 4;
/// Width of a digit and height of a line, for the drawing's letters.
const LETTER: [f64; 2] = [6.4, 11.0];
/// Room that a sign takes around its place.
const SIGN: f64 = 4.0;
/// Distances at which room is looked for, and that from which a line leads to the station.
const DISTANCES: [f64; 5] = [11.0, 16.0, 23.0, 32.0, 44.0];
const LED: f64 = 17.0;

type Rect = [f64; 4];

fn overlap(a: &Rect, b: &Rect) -> f64 {
    let side = |k: usize| (a[k + 2].min(b[k + 2]) - a[k].max(b[k])).max(0.0);
    side(0) * side(1)
}

/// Numbers of stations; consecutive ones as a range.
fn ranges(ids: &[&str]) -> String {
    let mut parts: Vec<(String, Option<(u64, u64)>)> = Vec::new();
    for id in ids {
        let number = id.parse::<u64>().ok();
        match (parts.last_mut(), number) {
            (Some((_, Some((_, last)))), Some(n)) if n == *last + 1 => *last = n,
            _ => parts.push(((*id).to_owned(), number.map(|n| (n, n)))),
        }
    }
    let left = parts.len().saturating_sub(MOST);
    let told = parts.iter().take(MOST).map(|(id, range)| match range {
        Some((first, last)) if last == first => id.clone(),
        Some((first, last)) if *last == first + 1 => format!("{first}, {last}"),
        Some((first, last)) => format!("{first}–{last}"),
        None => id.clone(),
    });
    let mut told: Vec<String> = told.collect();
    if left > 0 {
        told.push("…".to_owned());
    }
    told.join(", ")
}

/// A label for every station, in the order in which they were given.
pub fn labels(signs: &[Sign]) -> Vec<StationLabel> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for (k, sign) in signs.iter().enumerate() {
        let near = |group: &&mut Vec<usize>| {
            let [x, y] = signs[group[0]].at;
            (x - sign.at[0]).hypot(y - sign.at[1]) < ONE_PLACE
        };
        match groups.iter_mut().find(near) {
            Some(group) => group.push(k),
            None => groups.push(vec![k]),
        }
    }
    let mut taken: Vec<Rect> =
        groups.iter().map(|g| signs[g[0]].at).map(|[x, y]| [x - SIGN, y - SIGN, x + SIGN, y + SIGN]).collect();
    groups.into_iter().map(|group| placed(signs, group, &mut taken)).collect()
}

/// The nearest place that is free, behind the station first; the one that covers least where none is.
fn placed(signs: &[Sign], group: Vec<usize>, taken: &mut Vec<Rect>) -> StationLabel {
    let text = ranges(&group.iter().map(|k| signs[*k].id.as_str()).collect::<Vec<_>>());
    let (half, high) = (text.chars().count() as f64 * LETTER[0] / 2.0, LETTER[1]);
    let Sign { at: [x, y], back, .. } = &signs[group[0]];
    let mut best: Option<(f64, [f64; 2], Rect)> = None;
    'all: for distance in DISTANCES {
        for turn in [0, 1, -1, 2, -2, 3, -3, 4] {
            let (s, c) = (f64::from(turn) * std::f64::consts::FRAC_PI_4).sin_cos();
            let (dx, dy) = (back[0] * c - back[1] * s, back[0] * s + back[1] * c);
            // the middle of the text, at a distance of half its width
            let (u, v) = (x + dx * (distance + (half - LETTER[0] / 2.0).max(0.0)), y + dy * distance);
            let rect = [u - half, v - high / 2.0, u + half, v + high / 2.0];
            let outside = rect[0] < 0.0 || rect[1] < 0.0 || rect[2] > WIDTH || rect[3] > HEIGHT;
            let covered = taken.iter().map(|other| overlap(&rect, other)).sum::<f64>();
            let cost = covered + if outside { 1e3 } else { 0.0 };
            // nearer is better among equals
            if best.as_ref().is_none_or(|(least, ..)| cost < *least - 1e-9) {
                best = Some((cost, [u, v], rect));
            }
            if cost == 0.0 {
                break 'all;
            }
        }
    }
    let (_, [u, v], rect) = best.unwrap_or((0.0, [*x, *y], [*x, *y, *x, *y]));
    taken.push(rect);
    let far = (u - x).hypot(v - y) - (half - LETTER[0] / 2.0).max(0.0) > LED;
    StationLabel { at: [u, v + high / 2.0 - 1.5], text, of: group, leader: far.then_some([*x, *y]) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sign(x: f64, y: f64, id: impl ToString) -> Sign {
        Sign { at: [x, y], back: [0.0, 1.0], id: id.to_string() }
    }

    #[test]
    fn a_station_alone_has_its_number_behind_it() {
        let all = labels(&[sign(100.0, 100.0, 7)]);
        assert_eq!((all[0].text.as_str(), all[0].leader), ("7", None));
        assert!((all[0].at[0] - 100.0).abs() < 1e-9 && all[0].at[1] > 105.0 && all[0].at[1] < 120.0);
    }

    #[test]
    fn stations_at_one_place_share_a_line() {
        let all = labels(&[sign(100.0, 100.0, 1), sign(300.0, 100.0, 2), sign(101.0, 99.0, 3), sign(99.0, 101.0, 4)]);
        let texts: Vec<&str> = all.iter().map(|l| l.text.as_str()).collect();
        assert_eq!(texts, ["1, 3, 4", "2"]);
        assert_eq!(all[0].of, [0, 2, 3]);
        let ids: Vec<String> = (1..=12).filter(|n| *n != 6).map(|n| n.to_string()).collect();
        let ids: Vec<&str> = ids.iter().map(String::as_str).collect();
        assert_eq!(ranges(&ids), "1–5, 7–12");
        assert_eq!(ranges(&["1", "3", "5", "7", "9", "a"]), "1, 3, 5, 7, …");
    }

    /// Forty stations in two close rows: no number lies on another or on another station.
    #[test]
    fn no_number_lies_on_another() {
        let signs: Vec<Sign> =
            (0..40).map(|k| sign(80.0 + 24.0 * f64::from(k % 20), 120.0 + 14.0 * f64::from(k / 20), k + 1)).collect();
        let all = labels(&signs);
        assert_eq!(all.len(), 40);
        let rect = |label: &StationLabel| {
            let (half, v) = (label.text.chars().count() as f64 * LETTER[0] / 2.0, label.at[1] + 1.5 - LETTER[1] / 2.0);
            [label.at[0] - half, v - LETTER[1] / 2.0, label.at[0] + half, v + LETTER[1] / 2.0]
        };
        for (k, a) in all.iter().enumerate() {
            assert!(all[..k].iter().all(|b| overlap(&rect(a), &rect(b)) < 1e-6), "{a:?}");
            let [x, y] = [0, 1].map(|i| signs[k].at[i]);
            assert!((a.at[0] - x).hypot(a.at[1] - y) < 60.0, "{a:?}");
            for s in &signs {
                let [u, v] = s.at;
                assert!(overlap(&rect(a), &[u - SIGN, v - SIGN, u + SIGN, v + SIGN]) < 1e-6, "{a:?} on {s:?}");
            }
        }
    }
}
