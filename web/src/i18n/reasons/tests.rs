//! Tests of the words of reasons.

use sightline::error::{Lack, PictureKind, Thing};

use super::*;

/// Every choice of words is one of the field's, and no two things share theirs by mistake.
#[test]
fn things_are_told_apart() {
    let mut words: Vec<_> = Thing::ALL.iter().map(|one| thing(*one)).collect();
    words.sort_unstable();
    words.dedup();
    assert_eq!(words.len(), Thing::ALL.len());
    assert!(Lack::ALL.iter().all(|one| !lack(*one).is_ascii()));
    let kinds = ["MP4 or QuickTime video", "lossless JPEG", "PNG of a rare kind", "RAW (NEF of A B)", "HEIF of j2k1"];
    for kind in kinds.map(|words| PictureKind::from(words.to_owned())) {
        assert!(!picture(&kind).is_ascii(), "{kind}");
    }
    assert_eq!(picture(&PictureKind::Raw("Canon CR2".into())), "RAW (Canon CR2)");
}

#[test]
fn values_are_carried_over() {
    let told = reason(&Reason::NotANumber { name: "Y".into(), text: "zwei".into() });
    assert_eq!(told, "Y가 수가 아닙니다: \"zwei\"");
    let told = reason(&Reason::DiametersSwapped { min_diameter: 9.5.into(), max_diameter: 4.0.into() });
    assert_eq!(told, "최소 지름 9.5가 최대 지름 4보다 큽니다");
}

/// Reasons of the crates above the engine come from a worker as JSON, and have their sentences again in both languages.
#[test]
fn reasons_of_other_crates_have_their_sentences() {
    use sightline_exchange::reason::ExchangeReason;
    use sightline_lab::reason::LabReason;
    use sightline_plan::reason::PlanReason;
    use sightline_report::reason::ReportReason;
    let all: [(Reason, String); 4] = [
        (ExchangeReason::NoPixels.into(), ExchangeReason::NoPixels.to_string()),
        (PlanReason::PlanTooLarge { limit: 9 }.into(), PlanReason::PlanTooLarge { limit: 9 }.to_string()),
        (ReportReason::SheetNothing.into(), ReportReason::SheetNothing.to_string()),
        (LabReason::Rounds { limit: 7 }.into(), LabReason::Rounds { limit: 7 }.to_string()),
    ];
    for (told, english) in all {
        let json = serde_json::to_string(&told).expect("JSON");
        let come: Reason = serde_json::from_str(&json).expect("a reason");
        assert_eq!(super::super::declared::english(&come), english);
        assert!(!reason(&come).is_ascii(), "{json}");
    }
}
