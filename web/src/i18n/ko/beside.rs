//! 작업 단계 옆에 있는 것의 글: 이전 결과와의 비교, 프로젝트를 넘어 쓰는 장비, 오래 걸리는 일.

use super::{Korean, choose};
use crate::i18n::translate;

translate! { Korean comparing {
    beside_before: "이전 결과와 비교";
    figures(before, after, redundancy_before, redundancy_after):
        "σ₀ {before} → {after}, 잉여도 {redundancy_before} → {redundancy_after}.";
    moved_by(n, rms, unit, beyond, limit):
        "두 결과에 공통인 {n}점이 RMS {rms} {unit} 움직였고, 그중 {beyond}점은 표준오차의 {limit}배를 넘었습니다.";
    same_system: "두 결과는 같은 기준점의 좌표계에 있습니다.";
    fitted(points, scale):
        "두 결과의 좌표계가 서로 달라, 서로 맞는 공통점 {points}개로 이전 결과를 지금 결과에 맞추었습니다(축척 {scale}). 전체가 함께 움직인 것은 드러나지 않습니다.";
    fitted_rigidly(points):
        "두 결과의 좌표계가 서로 달라, 서로 맞는 공통점 {points}개로 이전 결과를 지금 결과에 맞추었습니다. 둘 다 축척이 있으므로 축척은 맞추지 않았습니다. 전체가 함께 움직인 것은 드러나지 않습니다.";
    unlike(common, agreeing):
        "좌표는 비교하지 않았습니다. 어떤 닮음변환으로도 두 망이 맞지 않습니다. 공통점 {common}개 가운데 표준오차 안에서 맞는 점은 {agreeing}개뿐이어서 무엇이 움직였는지 알 수 없습니다. 점 이름이 바뀌지 않았습니까?";
    unlike_mirrored(common, agreeing):
        "좌표는 비교하지 않았습니다. 두 망이 서로 거울상입니다. 그대로는 공통점 {common}개 가운데 {agreeing}개만 표준오차 안에서 맞습니다. 기준점의 축이 바뀌거나 부호가 뒤집히지 않았습니까?";
    unlike_scale(common, agreeing, scale):
        "좌표는 비교하지 않았습니다. 두 망에 모두 축척이 있는데도 이전 망의 길이에 {scale}{scale:을|를} 곱해야 맞습니다. 그대로는 공통점 {common}개 가운데 {agreeing}개만 표준오차 안에서 맞습니다. 거리나 그 단위가 바뀌지 않았습니까?";
    apart(common): "좌표는 비교하지 않았습니다. 두 결과의 공통점이 {common}개로 너무 적거나 한 직선 위에 있어 서로 맞출 수 없습니다.";
    other_units(before, after): "좌표는 비교하지 않았습니다. 길이 단위가 {before}에서 {after}{after:으로|로} 바뀌었습니다.";
    ratios_independent: "두 결과는 관측값을 공유하지 않으므로 분산을 더했으며, ‘× σ’는 점의 공분산으로 한 벡터 검정을 단일 검정의 한계에 맞춘 값입니다.";
    ratios_mean: "표준오차는 두 결과 중 큰 값이고, ‘× σ’는 축마다 구한 값 중 가장 큰 것입니다.";
    gone(n, points): "지금 결과에 없는 점 {n}개: {points}.";
    only_now(n, points): "지금 결과에 새로 들어온 점 {n}개: {points}.";
    unlike_cameras(cameras): "카메라 모델이나 사진좌표 단위가 바뀌어 비교하지 않은 카메라: {cameras}.";
    projection_centres: "투영중심";
    largest_sigma: "σ";
    times_sigma: "× σ";
    before: "이전";
    after: "지금";
    cancelled_result_kept: "취소했습니다. 이전 결과는 그대로 있습니다.";
    cancelled_result_old: "취소했습니다. 마지막 결과는 남아 있으며, 그때의 프로젝트에 대한 것입니다.";
    cancelled_no_result: "취소했습니다. 아직 결과가 없습니다.";
    residuals_by_photo: "사진별 잔차";
}}

translate! { Korean equipment {
    equipment: "장비";
    equipment_words: "검정한 카메라와 인증된 축척 막대를 이 컴퓨터와 파일에 두고, 사진에 보이면 바로 쓰게 합니다.";
    sentence(cameras, calibrations, bars): "카메라 {cameras}대, 검정 {calibrations}건, 축척 막대 {bars}개.";
    import_file: "파일 들여오기";
    export_file: "파일로 저장";
    kept_cameras: "카메라";
    kept_bars: "축척 막대";
    no_cameras: "아직 보관한 카메라가 없습니다. 카메라를 추정한 조정이 끝나면 아래에서 그 검정을 보관하십시오.";
    no_bars: "아직 보관한 축척 막대가 없습니다. 인증서에 적힌 값을 넣으십시오. 두 끝이 코드 표적이고 사진 두 장에 보이면 막대의 거리가 저절로 들어갑니다.";
    of_this_result: "지금 결과의 카메라";
    keep_calibration: "이 검정 보관";
    calibration_kept(camera): "{camera}의 검정을 이 컴퓨터에 보관했습니다.";
    calibrated_on(date): "{date} 검정";
    remove_camera(camera): "카메라 {camera} 빼기";
    remove_calibration(date): "{date} 검정 빼기";
    remove_bar(bar): "축척 막대 {bar} 빼기";
    removed: "보관 목록에서 뺐습니다.";
    put_back: "되돌리기";
    bar_name: "이름";
    certificate: "인증서";
    date: "날짜";
    date_hint: "2026-05-01";
    keep_bar: "막대 보관";
    not_kept: "이 브라우저의 저장소에 장비를 쓰지 못했습니다. 파일로 저장하십시오.";
    imported(file, cameras, calibrations, bars):
        "{file}: 새 카메라 {cameras}대, 검정 {calibrations}건, 축척 막대 {bars}개를 들여왔습니다.";
    known_camera(name, date): "보관한 카메라입니다: {name}, {date} 검정. 이 값을";
    held: "고정";
    held_means: "모든 매개변수를 검정한 값으로 고정합니다.";
    observed: "관측값으로";
    observed_means: "매개변수마다 검정의 표준오차를 가진 관측값으로 둡니다.";
    free: "추정";
    free_means: "검정한 값에서 시작해 모두 추정합니다.";
    bars_seen(bars): "사진에 보이는 축척 막대: {bars}.";
    take_bars: "거리 넣기";
    bars_taken(bars): "사진에 보이는 축척 막대의 거리를 넣었습니다: {bars}.";
    with_colours(colours): "{colours}에 대한 차이 포함";
    change_calibration(camera): "{camera} 검정 값 사용";
    change_bars(n): "축척 막대 거리 {n}개";
}}

translate! { Korean lasting {
    photo: "사진을 읽는 중";
    pixels: "사진의 화소값을 읽는 중";
    target: "표적을 측정하는 중";
    colours: "사진의 색별 위치를 측정하는 중";
    lens_colours: "렌즈의 색별 차이를 계산하는 중";
    situation: "점의 예상 위치를 보이려고 사진 표정을 구하는 중";
    features: "형상과 좌표계를 측정하는 중";
    report: "보고서를 만드는 중";
    report_stopped: "보고서 작성을 멈췄습니다. 다음 변경 후 다시 만듭니다.";
    plots: "그림을 그리는 중";
    comparison: "결과를 비교하는 중";
    sheets: "표적을 그리는 중";
    file: "파일을 쓰는 중";
    plan: "계획을 계산하는 중";
}}
