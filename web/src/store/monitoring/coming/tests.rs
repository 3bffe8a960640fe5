//! Tests of epochs as the desk has them.

use super::*;

#[test]
fn a_project_without_a_current_converged_result_is_no_epoch_and_says_what_to_do() {
    let adjustment = |termination: &str| {
        let text = format!(
            r#"{{"termination":"{termination}","iterations":[],"observations_count":0,"unknowns":0,"constraints":0,"redundancy":0,"sigma0":null,
                "global_test":null,"cameras":[],"photos":[],"points":[],"observations":[],"check_points":[],"precision":null}}"#
        );
        serde_json::from_str(&text).expect("an adjustment")
    };
    let mut document = Document::default();
    document.project_mut().name = "Wall".into();
    let reason = |document: &Document| of_document(document, None).err().map(|problem| problem.reason);
    assert_eq!(reason(&document), Some(Reason::EpochNotAdjusted));
    let with = |document: &mut Document, adjustment| {
        let input = document.project.clone();
        document.result = Some(Arc::new(AdjustmentResult { oriented: input.clone(), input, adjustment }));
    };
    with(&mut document, adjustment("iteration_limit"));
    assert!(matches!(
        reason(&document),
        Some(Reason::Engine(Error::Invalid { reason: Refusal::EpochNotConverged { .. }, .. }))
    ));
    with(&mut document, adjustment("converged"));
    assert_eq!(reason(&document), None);
    document.project_mut().unit = "m".into();
    assert_eq!(reason(&document), Some(Reason::EpochOutOfDate));
}

#[test]
fn matrices_are_told_from_lists() {
    let list = "CODE1,-1353.223,2028.707,488.368,0.043,0.025,0.021,0.000\n";
    assert!(!is_matrix(list));
    let line = |i: usize, n: usize| (0..n).map(|j| if i == j { "4" } else { "0.5" }).collect::<Vec<_>>().join(" ");
    let full: String = (0..6).map(|i| line(i, 6) + "\n").collect();
    let lower: String = (0..6).map(|i| line(i, i + 1) + "\n").collect();
    assert!(is_matrix(&full) && is_matrix(&lower) && is_matrix(&format!("a b\n{full}")));
    // Nine rows of nine numbers, the first of them names: no matrix, for it is not symmetric.
    let square: String = (1..=9)
        .map(|i| format!("{i} {}\n", (0..8).map(|j| (i * 10 + j).to_string()).collect::<Vec<_>>().join(" ")))
        .collect();
    assert!(!is_matrix(&square) && !is_matrix(""));
}
