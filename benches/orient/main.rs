//! Orientation over seeded networks: `cargo bench --bench orient -- [first] [count] [most photos] [-v] [-n]`, with -v a line
//! for every network, with -n its notes;
//! `-- large [first] [count]` for 60 photos with 300 points, `-- huge [first] [count]` for 200 with 1000; `-- seeds 3 14 15` (and `-- large seeds 2`) for those networks alone,
//! a line for each; `-- dots` for the matching of bare dots; `-- write FOLDER` (and `-- large write FOLDER`) writes what orientation
//! is given of the networks, for `benches/oriented.mjs`.

mod dots;
mod network;

use std::collections::BTreeMap;
use std::sync::OnceLock;
use std::time::Instant;

use network::{Case, KINDS, judged};
use sightline::orient::orient;

/// Seconds this process has computed, which others on the machine do not change; elapsed seconds if the system does not report them.
fn seconds_used() -> f64 {
    static BEGAN: OnceLock<Instant> = OnceLock::new();
    let began = BEGAN.get_or_init(Instant::now);
    let told = std::fs::read_to_string("/proc/self/schedstat").ok();
    let nanoseconds = told.and_then(|text| text.split(' ').next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(|| began.elapsed().as_secs_f64(), |ns| 1e-9 * ns)
}

/// 200 photos with 1000 points, seen in 6, 15 or 40 photos, otherwise as the large ones.
fn huge_case(seed: u64) -> Case {
    let case = Case::large(seed);
    Case { photos: 200, size: case.size.map(|[_, rays]| [1000.0, rays]), ..case }
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    if words.iter().any(|w| w == "dots") {
        println!("photos dots seconds wanted found share wrong");
        for (photos, dots, tolerance) in [
            (3, 600, None),
            (4, 600, None),
            (3, 2500, None),
            (4, 2500, None),
            (8, 2500, None),
            (15, 2500, None),
            (30, 2500, None),
            (30, 2500, Some(10.0)),
        ] {
            let m = dots::matched(1, photos, dots, tolerance);
            let share = 100.0 * m.found as f64 / m.wanted.max(1) as f64;
            println!(
                "{photos:6} {dots:5} {:6.2} {:6} {:5} {share:5.1}% {:4} {tolerance:?}",
                m.seconds, m.wanted, m.found, m.wrong
            );
        }
        return;
    }
    let numbers: Vec<u64> = words.iter().filter_map(|a| a.parse().ok()).collect();
    let huge = words.iter().any(|w| w == "huge");
    let large = huge || words.iter().any(|w| w == "large");
    let named = words.iter().any(|w| w == "seeds");
    let first = numbers.first().copied().unwrap_or(0);
    let count = numbers.get(1).copied().unwrap_or(if large { 21 } else { 1500 });
    let most = numbers.get(2).filter(|_| !named).map_or(60, |n| *n as usize);
    let wordy = large || named || words.iter().any(|w| w == "-v");
    let (seeds, said) = match named {
        true => (numbers.clone(), format!("{} seeds", numbers.len())),
        false => ((first..first + count).collect(), format!("seeds {first}+{count}")),
    };
    // Per group: networks, solvable, right, missing photos, silent, silent c, falsely wrong networks (clean only), seconds.
    let mut groups: BTreeMap<String, [f64; 8]> = BTreeMap::new();
    let folder = words.iter().position(|w| w == "write").and_then(|at| words.get(at + 1));
    for seed in seeds {
        let case = match (huge, large) {
            (true, _) => huge_case(seed),
            (_, true) => Case::large(seed),
            _ => Case::of(seed, most),
        };
        let network = network::network(&case);
        if let Some(folder) = folder {
            let json = serde_json::to_vec(&network.given).expect("a document");
            std::fs::write(format!("{folder}/{seed}.json"), json).expect("a folder to write to");
            continue;
        }
        let began = seconds_used();
        let oriented = match orient(&network.given) {
            Ok(oriented) => oriented,
            Err(error) => {
                println!("{seed}: {error}");
                continue;
            }
        };
        let seconds = seconds_used() - began;
        let verdict = judged(&network, &oriented);
        let rays = network.given.observations.len() as f64 / network.given.points.len() as f64;
        let bad = verdict.solvable && (!verdict.right || !verdict.wrong.is_empty()) || verdict.silent_c;
        let clean = case.wrong == 0.0;
        if bad || clean && verdict.falsely_wrong > 0 || wordy {
            println!(
                "{seed} {} {} photos, {rays:.1} rays, c {:?}, wrong {}: solvable {}, right {}, missing {}, silent {}, \
                 silent c {}, falsely wrong {}, {:.2} s {}",
                KINDS[case.kind],
                case.photos,
                case.distance,
                case.wrong,
                verdict.solvable,
                verdict.right,
                verdict.missing,
                verdict.wrong.len(),
                verdict.silent_c,
                verdict.falsely_wrong,
                seconds,
                verdict.failure.as_deref().unwrap_or("")
            );
        }
        if words.iter().any(|w| w == "-n") {
            oriented.notes.iter().for_each(|note| println!("    {note:?}"));
            for (photo, [degrees, hundredths]) in &verdict.wrong {
                let mut told = BTreeMap::new();
                for (k, o) in oriented.project.observations.iter().enumerate().filter(|(_, o)| o.photo == *photo) {
                    let enabled = oriented.project.observations.iter().filter(|p| p.enabled && p.point == o.point);
                    let aside = oriented.project.set_aside.iter().find(|s| s.photo == *photo && s.point == o.point);
                    let wrong = network.wrong.contains(&k);
                    *told.entry((aside.map(|s| format!("{:?}", s.reason)), enabled.count(), wrong)).or_insert(0) += 1;
                }
                println!(
                    "    {photo} is wrong by {degrees:.2} degrees, {hundredths:.2} %; reason, rays, wrong name: {told:?}"
                );
            }
        }
        let (a, b, c) =
            (KINDS[case.kind].to_string(), format!("c {:?}", case.distance), format!("wrong {}", case.wrong));
        for group in ["all".to_string(), a, b, c] {
            let sums = groups.entry(group).or_default();
            let flag = |yes: bool| f64::from(u8::from(yes));
            let one = [
                1.0,
                flag(verdict.solvable),
                flag(verdict.solvable && verdict.right),
                flag(verdict.solvable && verdict.missing > 0),
                flag(!verdict.wrong.is_empty()),
                flag(verdict.silent_c),
                flag(clean && verdict.falsely_wrong > 0),
                seconds,
            ];
            sums.iter_mut().zip(one).for_each(|(sum, x)| *sum += x);
        }
    }
    println!("{said:14} networks solvable right  share missing silent c-silent falsely mean s");
    for (name, s) in groups {
        let share = 100.0 * s[2] / s[1].max(1.0);
        println!(
            "{name:14} {:8} {:8} {:5} {share:5.1}% {:7} {:6} {:8} {:7} {:6.2}",
            s[0],
            s[1],
            s[2],
            s[3],
            s[4],
            s[5],
            s[6],
            s[7] / s[0]
        );
    }
}
