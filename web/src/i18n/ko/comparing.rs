//! 두 결과를 비교하는 문장.

use super::{Korean, choose};
use crate::i18n::translate;

translate! { Korean comparing {
    beside_before: "이전 결과와 비교";
    figures(before, after, redundancy_before, redundancy_after):
        "σ₀ {before} → {after}, 잉여도 {redundancy_before} → {redundancy_after}.";
    moved_by(n, rms, unit, beyond, limit):
        "두 결과에 공통인 {n}점이 RMS {rms} {unit} 움직였고, 그중 {beyond}점은 표준오차의 {limit}배를 넘었습니다.";
    same_system: "두 결과는 같은 기준점 좌표계에 있습니다.";
    fitted(points, scale):
        "두 결과의 좌표계가 서로 다릅니다. 서로 맞는 공통점 {points}개로 이전 결과를 현재 결과의 좌표계로 변환했습니다(축척 {scale}). 망 전체의 이동은 검출할 수 없습니다.";
    fitted_rigidly(points):
        "두 결과의 좌표계가 서로 다릅니다. 서로 맞는 공통점 {points}개로 이전 결과를 현재 결과의 좌표계로 변환했습니다. 두 결과에 모두 축척이 있으므로 축척은 변환하지 않았습니다. 망 전체의 이동은 검출할 수 없습니다.";
    unlike(common, agreeing):
        "좌표는 비교하지 않았습니다. 두 망에 맞는 상사변환이 없습니다. 공통점 {common}개 가운데 {agreeing}개만 표준오차 안에서 일치하여 무엇이 움직였는지 알 수 없습니다. 점 이름이 바뀌었는지 확인하십시오.";
    unlike_mirrored(common, agreeing):
        "좌표는 비교하지 않았습니다. 두 망이 서로 거울상입니다. 그대로는 공통점 {common}개 가운데 {agreeing}개만 표준오차 안에서 일치합니다. 기준점의 축이 바뀌거나 부호가 바뀌었는지 확인하십시오.";
    unlike_scale(common, agreeing, scale):
        "좌표는 비교하지 않았습니다. 두 망에 모두 축척이 있으나 이전 길이에 {scale}{scale:을|를} 곱해야 맞습니다. 그대로는 공통점 {common}개 가운데 {agreeing}개만 표준오차 안에서 일치합니다. 거리나 그 단위가 바뀌었는지 확인하십시오.";
    apart(common): "좌표는 비교하지 않았습니다. 두 결과의 공통점이 {common}개로 너무 적거나 한 직선 위에 있어 변환할 수 없습니다.";
    other_units(before, after): "좌표는 비교하지 않았습니다. 길이 단위가 {before}에서 {after}{after:으로|로} 바뀌었습니다.";
    ratios_independent: "두 결과는 관측값을 공유하지 않으므로 분산을 더합니다. ‘× σ’는 점의 공분산을 쓴 벡터 검정의 값을 단일 검정의 한계에 맞춘 것입니다.";
    ratios_union: "표준오차는 두 결과의 모든 관측값에서 계산한 차이의 표준오차이며, 공유한 관측값의 오차는 상쇄됩니다. ‘× σ’는 벡터 검정을 단일 검정의 한계에 맞춘 값입니다.";
    ratios_mean: "표준오차는 두 결과 중 큰 값이고, ‘× σ’는 세 축 가운데 가장 큰 값입니다.";
    gone(n, points): "지금 결과에 없는 점 {n}개: {points}.";
    only_now(n, points): "지금 결과에 새로 들어온 점 {n}개: {points}.";
    unlike_cameras(cameras): "카메라 모형이나 사진좌표 단위가 바뀌어 비교하지 않은 카메라: {cameras}.";
    projection_centres: "투영중심";
    largest_sigma: "σ";
    times_sigma: "× σ";
    before: "이전";
    after: "지금";
    cancelled_result_kept: "취소했습니다. 이전 결과를 그대로 둡니다.";
    cancelled_result_old: "취소했습니다. 마지막 결과를 그대로 두며, 이는 프로젝트의 이전 상태에 대한 결과입니다.";
    cancelled_no_result: "취소했습니다. 아직 결과가 없습니다.";
    residuals_by_photo: "사진별 잔차";
} }
