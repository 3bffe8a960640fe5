//! 실험의 문장.

use super::{Korean, choose};
use crate::i18n::translate;

translate! { Korean experiments {
    // The pages
    experiments: "실험";
    experiments_words: "한국 논문 세 편을 다시 실행합니다. 논문의 망을 모의하고 조정하여 논문의 수치와 나란히 보입니다.";
    running: "실험 실행 중";
    run: "실행";
    run_again: "다시 실행";
    open_as_project: "프로젝트로 열기";
    not_run_yet: "몇 초 동안 실행한 뒤 논문의 값과 나란히 여기에 수치가 나타납니다. 그동안에도 페이지를 쓸 수 있습니다.";
    inputs_changed: "마지막 실행 뒤에 입력이 바뀌었습니다. 다시 실행하면 새 입력의 수치가 나타납니다.";
    ran_in(seconds): "{seconds} s에 실행";
    vary: "입력값";
    network: "망";
    turn: "망을 3차원으로 돌려 보기";
    turned: "3차원 망";
    not_turned(detail): "3차원 보기를 표시할 수 없습니다({detail}). 브라우저에서 하드웨어 가속이나 WebGL을 켜십시오.";
    drawing_shown: "그린 망";
    plan: "평면";
    elevation: "입면";
    assumed: "가정";
    assumed_aside: "논문에 없거나 논문과 다른 것";
    ours: "여기";
    paper: "논문";
    paper_of(what): "{what}, 논문";
    independent: "독립 계산";
    difference: "차이";
    figure: "항목";
    figures: "수치";
    no_paper_figure: "논문에 없음";
    rows(n): "{n}행";

    // Questions, one an experiment
    kang: "강준묵·유복모 1985";
    kang_question: "사진을 더 찍으면 좌표가 얼마나 정확해지는가?";
    kang_source: "강준묵, 유복모 (1985), 다중 근거리사진측정에 의한 피사체의 3차원 정밀해석에 관한 연구.";
    film: "필름";
    film_question: "지표와 왜곡 보정표는 좌표측정기의 읽음값을 얼마나 바로잡는가?";
    film_source: "강준묵·유복모 (1985) 그림 3-2, 3-3의 절차를 여기서 만든 읽음값에 적용합니다.";
    lee_calibration: "이진덕 1996, 자체검정";
    lee_calibration_question: "카메라는 화소에서 시작하여 얼마나 정확하게 자체검정되는가?";
    lee_source: "이진덕 (1996), 산업정밀측정에서 수치영상을 이용한 근접사진측량의 효율적 응용.";
    lee_structure: "이진덕 1996, 구조물";
    lee_structure_question: "수렴 촬영과 자유망으로 무엇이 좋아지는가?";
    sensor: "센서와 JPEG";
    sensor_question: "센서에서 카메라의 JPEG까지 가는 동안 중심과 좌표의 정확도는 얼마나 떨어지는가?";
    sensor_source: "자체 실험: 렌즈와 색 필터를 거쳐 광자 잡음과 함께 렌더링한 한 번의 노출을 카메라의 처리 단계마다 측정합니다. 사진 6매를 자유망에서 자체검정하여 참 중심, 참 좌표와 비교합니다.";
    step_sites: "RAW";
    step_demosaiced: "색 보간";
    step_sharpened: "선명화";
    step_toned: "톤 곡선";
    step_jpeg_92: "JPEG 92";
    step_jpeg_75: "JPEG 75";
    step_of_camera: "측정 단계";
    error_over_sigma: "오차 / σ";
    object_rms: "좌표 오차, RMS";
    object_sigma: "제시된 σ, RMS";
    over_sites: "RAW 대비";
    visible: "보이는 중심";
    t_sensor_steps: "처리 단계별 정확도 저하";
    c_sensor_centres: "중심의 오차";
    c_sensor_objects: "좌표의 오차와 제시된 표준오차";
    a_sharpening(v): "선명화는 3 × 3 화소 이항 평균과의 차이를 {v} % 더합니다.";
    kim: "김혁길·황진상·윤홍식 2015";
    kim_question: "사진 두 매는 DLT에서 전방교회까지 얼마나 정확한가?";
    kim_source: "김혁길, 황진상, 윤홍식 (2015), DLT와 부가변수에 의한 광속조정법을 활용한 근접사진측량의 3차원 위치정확도 분석.";

    // Plates of one's own
    plates: "내 건판으로";
    plates_words: "카메라, 지표, 왜곡 보정표를 한 줄에 하나씩 적고 읽음값(사진, 지표 또는 점, x, y, 측정기 좌표 mm)을 추가하십시오.";
    plates_description: "카메라와 건판 설명";
    plates_files: "파일에서 읽음값…";
    plates_scans: "스캔에서 측정한 값";
    plates_scans_words: "스캔 사진: 표적 단계에서 지표와 점을 찍고, 점 이름 단계에서 지표를 위와 같은 이름으로 지정한 뒤 여기로 돌아오십시오.";
    plates_reduced(photos, observations): "사진 {photos}매 변환, 관측 {observations}개.";

    // Inputs
    in_distance: "촬영거리";
    in_mixed: "여러 거리 혼합";
    in_combination: "조합";
    in_photos: "사진 매수";
    in_overlap: "중복도";
    in_network: "프로젝트의 망";
    in_datum: "프로젝트의 기준계";
    in_image_sigma: "사진좌표 σ, µm";
    in_control_sigma: "기준점 좌표 σ, mm";
    in_pixel_noise: "화소 잡음, 최댓값의 %";
    in_rounds: "몬테카를로 횟수";
    in_seed: "잡음 시드";
    in_method: "조정할 중심";
    in_left_out: "두 번째 조정에서 뺄 사진";
    left_out_hint: "번호를 빈칸으로 구분";

    // Words for names in cells, on axes and after figures
    all: "전체";
    reduced: "사진을 뺀 뒤";
    control: "기준점";
    free: "자유망";
    observed: "관측값";
    unknown: "미지수";
    yes: "예";
    no: "아니요";
    greatest: "최대";
    least: "최소";
    mean: "평균";
    standard_deviation: "표준편차";
    rms: "RMS";
    similarity: "상사변환";
    affine: "아핀변환";
    projective: "투영변환";
    similarity_corrected: "상사변환, 왜곡 보정";
    affine_corrected: "아핀변환, 왜곡 보정";
    projective_corrected: "투영변환, 왜곡 보정";
    field: "시험장";
    planes: "두 평면";
    all_photos: "전체 사진";

    // Words for identifiers of tables and charts
    t_single: "한 거리의 망 60개";
    t_mixed: "여러 거리를 섞은 망 16개";
    t_improvement: "사진 2매에 대한 M₀, Mₛ의 감소";
    t_pairwise: "공면조건 모델 쌍과 광속조정";
    t_fiducials: "지표의 잔차";
    t_transformations: "변환 계수";
    t_distortion: "왜곡 보정표와 기수차 다항식";
    t_reductions: "보정 방법별 광속조정 결과";
    t_photos: "사진별 잔차";
    t_parameters: "카메라 매개변수";
    t_two_rays: "사진 두 매에만 찍힌 점";
    t_estimators: "참값과 비교한 표적 중심, 좋은 순";
    t_standard_errors: "표준오차";
    t_free_gain: "자유망의 향상률";
    t_check_points: "검사점, 사진측량 − 측량";
    t_statistics: "차이의 통계";
    t_orientation: "외부표정요소";
    t_interior: "내부표정요소";
    c_errors(n): "사진 {n}매의 표준오차";
    c_improvement(d): "{d} m에서의 향상률";
    c_mixed: "여러 거리를 섞은 망의 표준오차";
    c_standard_errors(axis): "표준오차 {axis}";
    c_pairwise: "사진 3매의 오차: 모델 쌍과 광속조정";
    c_distortion: "방사왜곡";
    c_distortion_error: "방사왜곡, 여기 − 참값";
    c_way(axis, photo): "사진 {photo}의 {axis} 수렴";

    // Axes, columns, lines, figures
    photo: "사진";
    point: "점";
    points: "점";
    photos: "사진";
    count: "비교한 수";
    found: "검출한 수";
    overlap_type: "유형(중복도)";
    standard_error: "표준오차";
    rms_error: "RMS 오차";
    improvement: "향상률";
    distance: "거리";
    observations: "관측수 m";
    unknowns: "미지수 n";
    equations: "방정식";
    datum: "기준계";
    parameters: "부가매개변수";
    relative: "상대정확도";
    relative_median: "상대정확도(중앙값)";
    papers_instrument(mm): "논문의 장비로 실행(기준점 σ {mm} mm)";
    rays: "광선 수";
    photos_of_run: "사진";
    relative_column: "상대정확도 1 :";
    method: "방법";
    largest: "최대";
    mark: "지표";
    kind: "변환";
    parameter: "계수";
    value: "값";
    radius: "반지름";
    distortion: "왜곡";
    table: "보정표";
    polynomial: "다항식";
    residual: "잔차";
    corrected: "왜곡 보정";
    bundle_sigma0: "광속조정 σ₀";
    marks_sigma0: "지표 σ₀";
    planted: "참값(논문 값)";
    error: "오차";
    element: "요소";
    dlt: "DLT";
    bundle: "광속조정";
    statistic: "통계량";
    total: "전체";
    iteration: "반복";
    iterations: "0.1 mm 안으로 수렴한 반복 수";
    check_points: "검사점";
    base_fall(base): "B/D 0.2 → {base}에서 M₀ 감소";
    fall_of(what): "{what} 감소";
    m0_mean(n): "2매 대비 {n}매, M₀ 평균 감소";
    m0_up_to(n): "2매 대비 {n}매, M₀ 최대 감소";
    m0_least: "유형별 M₀ 최소 감소";
    m0_greatest: "유형별 M₀ 최대 감소";
    monte_carlo(axis): "몬테카를로 산포와 S{axis}의 차";
    residual_axis(axis): "잔차 {axis}";
    rms_sigma(axis): "RMS σ{axis}";
    error_of(what): "{what} 오차, σ 단위";
    gain_of(axis): "자유망 향상률 {axis}";
    centre_rms: "중심 오차 RMS";
    distortion_sigma0: "다항식 σ₀";
    pair_unaided: "모델 쌍, 최적합, 한 번";
    pair_draws: "모델 쌍, 광축 평행, 네 번";
    bundle_draws: "광속조정, 네 번";
    pair_of(axis): "모델 쌍 {axis}";
    bundle_of(axis): "광속조정 {axis}";
    pair_rms_draws: "모델 쌍 RMS, 네 번";
    bundle_rms_draws: "광속조정 RMS, 네 번";
    pair_unaided_rms: "모델 쌍 최적합 RMS";
    pair_unaided_rms_draws: "모델 쌍 최적합 RMS, 네 번";
    reduced_of(what): "{what}, 사진을 뺀 뒤";

    // Assumptions, as sentences
    a_base_line_centre: "기선의 중심은 점들의 평균을 마주 봅니다. 논문에는 기선의 위치가 없습니다.";
    a_overall_means:
        "\"약 15, 35, 50 %까지\"는 논문 그림 4-6~4-9의 거리 1.4~4.0 m에서 읽었습니다. 3매와 4매는 평균, 5매는 최대 감소입니다. 7.0 m에서는 사진을 더할 때의 향상이 더 큽니다.";
    a_pairwise:
        "논문에서 공면조건 모델 쌍의 오차는 거리와 무관하게 불규칙했습니다. 우연오차만 있으면 여기서는 광속조정처럼 거리에 따라 커집니다. 방법 자체는 불규칙하지 않습니다. 깊이가 얕은 피사체의 두 번째 상호표정 해를 택하면 불규칙해집니다.";
    a_sigma0_draws(n): "S₀는 망마다 따로 뽑은 잡음 {n}회의 제곱평균제곱근이며 그 σ를 함께 보입니다. 논문의 값은 한 번의 측정에서 나온 것입니다.";
    a_film_draws(n): "보정 방법별 값은 측정값 잡음을 {n}회 뽑아 얻은 제곱평균제곱근입니다. 한 번만 뽑으면 어느 방법이 나은지가 우연에 좌우됩니다.";
    a_gain_misprint(ours, paper): "논문의 표 5에는 망 I의 Z가 {paper} %로 적혀 있으나 표 3과 표 4에서는 {ours} %가 됩니다. 오식으로 보고 {ours} %와 비교합니다.";
    a_readings: "읽음값은 여기서 만들었습니다. 보통의 건판을 위의 σ로 읽은 것입니다. 논문에는 없습니다.";
    a_distortion: "왜곡 보정표는 보통 크기로 만들었습니다. 논문에는 그림만 있습니다.";
    a_film_along(v): "필름은 길이 방향으로 {v}배 수축했습니다.";
    a_film_across(v): "필름은 폭 방향으로 {v}배 수축했습니다.";
    a_station_distance(v, paper):
        "촬영점은 {v} mm 거리입니다. 논문의 약 {paper} mm에서는 이 카메라가 2.0 × 1.5 m 가운데 1.9 × 1.3 m만 보여 표 1의 사진당 100~119점에 미치지 못합니다. 더 멀리서는 늘지만 그만큼은 아닙니다.";
    a_field_depth(v): "표적의 깊이 범위는 {v} mm입니다. 논문에는 \"3차원\"이라고만 적혀 있습니다.";
    a_station_directions: "촬영점은 ±10°, ±30°, ±50°의 호 위에 있습니다. 논문에는 수치 없이 그림만 있습니다.";
    a_psf(v): "렌즈 번짐은 {v} px(표준편차)입니다.";
    a_pixel_noise(v): "화소 잡음은 최댓값의 {v} %입니다(일정 성분과 광자 성분).";
    a_centroid: "논문에서 결과가 더 좋은 밝기값 중심을 조정합니다. 위에서 다른 중심을 고를 수 있습니다.";
    a_base_distance(v, paper):
        "기선은 벽에서 {v} mm 떨어져 있습니다. 논문의 약 {paper} mm에서는 이 카메라가 6.3 × 3.5 m 벽의 3.7 × 2.5 m만 봅니다. 7.4 m이면 망 I의 방정식이 논문과 같은 374개이지만 망 II의 사진이 위아래 줄을 보지 못합니다. 표준오차는 거리에 따라 커집니다.";
    a_ray_on_wall(v):
        "계산값은 논문의 두세 배입니다. 이 거리에서 광선 하나는 벽에서 {v} mm의 불확실성을 가지며, 여섯 광선이면 기껏해야 그 0.4배입니다. 3 µm로 망 I의 0.273 mm를 얻으려면 광선 21개, 또는 4.6 m 거리가 필요한데, 4.6 m에서는 사진 한 매에 벽의 3분의 1도 들어오지 않습니다. 반면 방정식 374개에는 사진마다 38점 중 30점이 보여야 합니다. 논문의 표준오차와 방정식 수는 한 기하에서 나올 수 없으므로 크기보다 순서와 개선율을 비교하십시오.";
    a_outer(v): "망 I의 바깥 촬영점은 중앙에서 {v} mm 떨어져 있습니다. 논문에 없습니다. 5 000~7 500 mm에서 깊이 정확도의 순서 III, I, II는 같습니다.";
    a_relief(v): "기둥의 표적은 벽보다 {v} mm 앞에 있습니다. 논문에 없습니다.";
    a_observed: "부가매개변수는 첫 실험의 검정 표준오차를 가진 관측값입니다. 논문에서는 미지수입니다. 표에 둘 다 있습니다. 미지수로 두면 망 II에서는 기준점 네 개가 검정을 개선하므로 자유망이 불리해집니다.";
    a_principal_distance(v): "주점거리는 {v} mm입니다. 논문에 없습니다. 사진축척은 약 1 : 1 100입니다.";
    a_survey(v): "측량 좌표의 오차는 {v} mm(1σ)입니다. 한 실내에서 한 번 설치하여 재므로 토털스테이션의 2 mm + 2 ppm보다 작게 두었습니다.";
    a_diameter(v): "표적 지름은 {v} mm입니다.";
    a_control_places: "기준점 65개는 검사점을 지나는 두 평면 위에 있습니다. 논문에는 검사점 15개만 있습니다.";
} }
