//! 백그라운드 작업의 이름.

use super::Korean;
use crate::i18n::translate;

translate! { Korean background {
    photo: "사진을 읽는 중";
    pixels: "사진의 화소값을 읽는 중";
    target: "표적을 측정하는 중";
    colours: "사진의 색별 위치를 측정하는 중";
    situation: "점의 예상 위치를 보이려고 사진 표정을 구하는 중";
    features: "형상과 좌표계를 측정하는 중";
    report: "보고서를 만드는 중";
    report_stopped: "보고서 작성을 멈췄습니다. 다음 변경 후 다시 만듭니다.";
    plots: "그림을 그리는 중";
    comparison: "결과를 비교하는 중";
    displaced: "사진에 나타낼 변위를 계산하고 있습니다";
    sheets: "표적을 그리는 중";
    file: "파일을 쓰는 중";
    plan: "계획을 계산하는 중";
} }
