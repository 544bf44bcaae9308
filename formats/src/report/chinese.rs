//! The words of findings in Chinese, by their codes. Each has a message and a remedy.
//!
//! Names and figures stand in the sentence of the finding itself, which follows in English. A code that is missing here
//! is told in English alone.

/// Code, meaning and remedy; the remedy is empty where nothing has to be done.
pub const FINDINGS: &[(&str, &str, &str)] = &[
    // The drape and its start.
    (
        "certificate-failed",
        "悬垂已计算并写出，但有检验指标超出限值，结果不可依赖。",
        "查看检验表，处理超限的指标后重新运行。",
    ),
    ("drape-not-settled", "服装在规定的步数或时间内没有静止。", "查看说明中指出的部位，固定无支撑的部分或放宽时间。"),
    (
        "start-crosses",
        "模拟开始前布料已与自身或人体相交，接触计算无法将其分开。",
        "在缝制文件中用 [[place]] 把裁片分开放置。",
    ),
    ("too-tight", "此处布料的应变超过限值，服装太紧。", "在此处放宽纸样、选大一号、换弹性更大的面料或更小的人体。"),
    ("unheld", "有裁片无任何支撑而掉落，检验不合格。", "缝合或固定该裁片，或用 [[attach]] 使其附着于人体。"),
    ("seam-open", "缝线未能闭合：中间有阻挡，或裁片够不到。", "把裁片放得离缝合位置更近。"),
    ("seam-reversed", "缝线两边方向相反，布料被扭转半圈。", "交换其中一边的起点和终点。"),
    ("seam-folds-over", "按所写方式缝合，裁片会叠在一起；通常是一边的起点与终点写反。", "交换其中一边的起点和终点。"),
    ("seam-out-of-reach", "缝线两边相距太远，缝线拉不到一起。", "把裁片并排放置，或删去它们的 [[place]]。"),
    ("seam-proposed", "此缝线由程序提出，尚无人确认。", "核对后在缝制文件中删去该缝线的 proposed。"),
    ("seam-eased", "缝线两边长度不同，差值在吃势范围内，较长的一边均匀归拢。", ""),
    ("seam-lengths-differ", "缝线两边长度差超过允许的吃势，且未声明吃势或抽褶。", "改正纸样，或声明 ease 或 gather。"),
    ("seam-notches-differ", "缝线两边的剪口不对应；按长度缝合。", "检查缝合的边是否正确。"),
    (
        "seams-close-cloth",
        "缝线把同一裁片相邻的两点缝成一点，而此处没有省道。",
        "按说明用 [[dart]] 声明省道，或让两条缝线止于同一处。",
    ),
    (
        "piece-not-placed",
        "没有说明该裁片在三维中的起始位置，也没有缝线说明。",
        "添加 [[place]]、将其缝到其他裁片，或将其排除。",
    ),
    ("pieces-exchanged", "两个裁片的位置互换了；交换后缝线短得多。", "交换两者的位置。"),
    ("arm-swapped", "袖片或袖头位于一侧手臂，却缝到身体另一侧。", "放到另一侧手臂，或缝到另一个袖窿。"),
    ("arranged", "没有 [[place]] 的裁片已按其作用和缝线自动摆放。", ""),
    ("start-moved", "裁片起始时位于人体或其他裁片内，已移开。", "在缝制文件中把它放在移开后的位置。"),
    ("start-raised", "腰部缝线起始处人体比它宽，裁片已上移或下移。", ""),
    ("start-repaired", "有顶点起始时在人体内，已推出。", ""),
    ("start-on-cone", "宽幅布环从环绕躯干的锥面开始。", ""),
    ("sewn-past-limb", "缝制时未与挡路的前臂接触；悬垂时与整个人体接触。", ""),
    ("fold-open", "服装上有压烫折线张开超过其角度的一半。", "检查折线旁的裁片和缝线。"),
    (
        "attach-part-of-ring",
        "固定在人体一圈上的边没有绕满整圈，会单独拉满全周。",
        "用 [[attach]] 把缝在两端的边也固定在同一位置。",
    ),
    (
        "attach-to-limb",
        "[[attach]] 指定了手臂或腿上的位置；只能固定在躯干和颈部。",
        "改用 [[elastic]]，或固定在躯干上。",
    ),
    ("attach-no-edge", "[[attach]] 指定的是边的一部分或裁片内的线；只能固定整条边。", "指定整条边的名称或编号。"),
    ("attached-twice", "两个 [[attach]] 指定了同一条边。", "保留其中一个。"),
    ("band-held", "松紧带缝在一直固定于人体的边上，不起作用。", "把固定方式改为 strength = \"while-sewing\"。"),
    ("band-slack", "松紧带比所缝的布料长，永远不会收紧。", "缩短松紧带。"),
    ("tables-contradict", "缝制文件中有两个表说的是同一对象，只能有一个成立。", "删去其中一个。"),
    ("pleat-sewn-beyond", "褶裥的缝合长度超出褶线末端。", "减小 sewn，或加长褶线。"),
    ("dart-off-cloth", "声明的省道或褶裥的省尖不在裁片的布料上。", "按裁片坐标给出省尖。"),
    ("fabric-chosen", "未指定面料；纸样中有罗纹裁片，因此选用了针织面料。", "用 --fabric 指定其他面料。"),
    ("sizes-carried", "一个尺码的改动已带到纸样的所有尺码。", ""),
    ("sizes-not-carried", "有改动未能带到其他尺码，说明中已列出。", "在其他尺码中另行修改。"),
    ("input-unused", "流水线声明的输入没有在任何文本中使用，设置它不起作用。", "在需要的地方写入该输入，或删去它。"),
    ("rests-apart", "起点相差 1 µm 时，服装静止位置的差异。", ""),
    ("elastic-at-rest", "静止服装上的松紧带：拉伸前后的长度及张力。", ""),
    ("motion-gate", "运动检验有指标超限。", "查看运动检验表。"),
    (
        "body-catches-cloth",
        "布料被夹在运动的人体部位之间，人体无法继续运动。",
        "留出更多空间，或减小 with.step 或 with.body_gap。",
    ),
    ("flat-triangle", "有三角形面积为零，该处布料没有刚度。", "重新划分网格。"),
    ("mesh-angle-low", "受图形所限，有三角形过尖；该处悬垂精度较低。", ""),
    // Body, fabric, measures.
    ("body-does-not-fit", "纸样的胸围或臀围不适合此人体。", "用 --body 选择其他人体。"),
    ("body-open", "人体网格有开口，布料可能滑入。", "封闭服装所在部位的孔洞。"),
    ("body-vertices-merged", "人体上位置相同的顶点已合并。", ""),
    ("fabric-missing", "没有指定面料。", "给出 with.fabric。"),
    ("measure-off", "测量点超出公差。", "修改纸样，或修改目标尺寸。"),
    ("measure-missing", "此服装上无法测量该测量点。", "按说明改正其名称。"),
    ("out-of-range", "数值超出合理范围。", "按说明中的范围改正。"),
    ("over-limit", "运行所需的时间或内存超过允许值。", "用 --max-seconds 和 --max-memory 放宽，或用更粗的网格。"),
    // The pattern.
    ("pieces-left-out", "按缝制文件的 leave_out，有裁片未缝入服装。", "如需缝入，从列表删去其名称并写出其缝线。"),
    ("pieces-refused", "文件中有裁片或尺码画错，无法使用。", "用 toile inspect 查看其错误。"),
    ("piece-not-in-size", "该裁片没有所选尺码，也没有放码规则；服装缺少此片。", "画出该尺码的裁片，或选择其他尺码。"),
    ("piece-lacks-size", "该裁片没有文件中的全部尺码，也没有放码规则。", "导出该裁片的每个尺码。"),
    ("size-not-found", "所选尺码既未画出，也无放码规则。", "从说明列出的尺码中选择。"),
    ("outline-crosses-itself", "裁片轮廓与自身相交，无法区分内外。", "在所示位置改正纸样。"),
    ("outline-loop-cut-off", "轮廓在拐角旁自交形成小环，已切除。", ""),
    ("grain-missing", "裁片没有丝缕线，以文件的 y 轴为经向。", "在纸样中画出丝缕线。"),
    ("grain-guessed", "网格没有布料坐标，以其高度方向为经向。", ""),
    ("units-guessed", "文件未注明单位，按裁片大小判断。", "设置 import-dxf 的 units。"),
    ("units-doubtful", "文件的单位使裁片大小不合理，或两处说明不一致。", "如判断有误，设置 import-dxf 的 units。"),
    ("edge-unknown", "裁片没有此名称或编号的边。", "用 toile inspect --svg 查看边的编号。"),
    ("dart-legs-differ", "省道两边长度不同，省口不齐。", "如非有意，请改正纸样。"),
    ("dart-candidate", "钻孔和剪口可能标示一个没有画线的省道。", "如是省道，用 [[dart]] 声明。"),
    ("wedge-not-a-dart", "有楔形像省道，但证据表明不是。", "如是省道，用 [[dart]] 声明。"),
    ("notch-cut-in", "剪口切入轮廓；按剪口读取，缝线从其上通过。", ""),
    ("notch-off-boundary", "剪口离轮廓太远，不是边上的标记。", "检查该剪口。"),
    ("fold-line-too-close", "折线离轮廓或其他线太近，不折叠。", ""),
    ("altered", "裁片已按要求修改。", ""),
    // Reading and writing files.
    ("curve-interpolated", "曲线点已按标准用光滑曲线连接。", ""),
    ("curve-points-unused", "有曲线点不在所保留的线上，未使用。", ""),
    ("curve-copy-lost", "此 DXF 格式没有曲线的密集副本；其他程序的曲线会略有偏差。", ""),
    ("dxf-profile", "写出此文件的程序，以及判断依据。", ""),
    ("ledger", "文件实体的统计：接受、按规则解释、拒绝。", ""),
    ("notch-shape-lost", "此 DXF 格式没有这种剪口形状，写成普通剪口。", ""),
    ("quantity-shared", "裁片与其副本分别写出，数量已分摊。", "请改正裁剪间所读的文字。"),
    ("quantity-without-sides", "AAMA 只有一个数量，镜像片已并入。", ""),
    ("style-text-not-kept", "款式的其他文字（作者、日期等）未保留。", ""),
    ("piece-name-changed", "裁片名称不能用作 DXF 块名，已改写。", ""),
    // Flattening.
    ("flatten-unedited", "悬垂后未编辑三维形状，裁片保持原样；悬垂应变留在布料中。", ""),
    ("flatten-out-of-tolerance", "有裁片的变化超出公差。", "检查该裁片，或放宽公差。"),
    ("flatten-open-seams", "悬垂有张开的缝线，展平的不是缝好的服装。", "先使缝线闭合。"),
    ("flatten-not-at-rest", "展平在静止之前结束，裁片是当时最好的结果。", "检查裁片，或增大 `max_rounds`。"),
    ("flatten-dart-kept", "省道保持形状所需的省量，或其原有省量。", ""),
    ("piece-not-developable", "裁片无法在应变限值内展平。", "在说明指出的位置加省道。"),
    ("shape-edited", "导出后 GLB 的顶点被移动过；展平会把修改带入裁片。", ""),
    (
        "body-side-file-differs",
        "人体附属文件中的尺寸与网格不符，或其中的标志点与所写高度不一致。",
        "若网格正确，从附属文件中删去该行并重新测量。",
    ),
    ("choice-overruled", "--set 改变了由精度或 --repeats 选定的值；此时不承诺精度。", "两者只保留其一。"),
    ("tolerance-empty", "容差文件没有写任何容差，因此没有作出任何判断。", "写入容差，或不使用 --tolerance。"),
];

/// Meaning and remedy of a code.
#[must_use]
pub fn of_code(code: &str) -> Option<[&'static str; 2]> {
    FINDINGS.iter().find(|(known, ..)| *known == code).map(|(_, what, remedy)| [*what, *remedy])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_code_stands_once_with_its_meaning() {
        for (k, (code, what, _)) in FINDINGS.iter().enumerate() {
            assert!(!what.is_empty() && FINDINGS[..k].iter().all(|(other, ..)| other != code), "{code}");
        }
    }
}
