#include "report/style.h"

namespace sahl::report {

std::string_view const style_sheet = R"css(
:root{color-scheme:light dark;--paper:#fcfbf9;--card:#fff;--ink:#1d2126;--soft:#5d6670;--line:#dcdfe3;--grid:#eceef0;
--accent:#0b6e75;--glass:#4d9fb3;--glass-fill:rgba(94,176,196,.16);--detector:#a04a18;
--detected:#1f8f6f;--absorbed:#d99a2b;--escaped:#7a97b5;--cut:#9276b8;--error:#c83a4a;
--good:#13694c;--good-fill:#e6f4ee;--bad:#a31f30;--bad-fill:#fbe9ea;--warn:#7a5200;--warn-fill:#fdf3dc}
@media (prefers-color-scheme:dark){:root{--paper:#13161a;--card:#1a1e23;--ink:#e6e8ea;--soft:#98a2ad;--line:#363d45;
--grid:#262c33;--accent:#5cc3ca;--glass:#6fb7c9;--glass-fill:rgba(111,183,201,.14);--detector:#e59a6b;
--detected:#39b48f;--absorbed:#e2ad4c;--escaped:#7d9cbd;--cut:#a78bcc;--error:#e2596a;
--good:#7fd6b3;--good-fill:#15302a;--bad:#ff9aa5;--bad-fill:#3a1a1f;--warn:#f0cf85;--warn-fill:#33290f}}
*{box-sizing:border-box}
body{margin:0;background:var(--paper);color:var(--ink);font:16px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,"Noto Sans","DejaVu Sans",sans-serif}
main{max-width:1180px;margin:0 auto;padding:2.2rem 1.5rem 4rem}
h1{font-size:1.9rem;line-height:1.2;margin:0 0 .3rem;font-weight:650;overflow-wrap:anywhere}
h2{font-size:1.2rem;margin:2.4rem 0 .8rem;font-weight:620}
h3{font-size:1rem;margin:0 0 .6rem;font-weight:620;overflow-wrap:anywhere}
p{margin:.4rem 0}
.note{color:var(--soft);font-size:.9rem}
.tiles{display:flex;flex-wrap:wrap;gap:.4rem 2.2rem;margin:1.1rem 0 0;padding:.9rem 0;border-top:1px solid var(--line);border-bottom:1px solid var(--line)}
.tiles div{display:flex;flex-direction:column}
.tiles b{font-size:1.15rem;font-weight:600;font-variant-numeric:tabular-nums}
.tiles span{color:var(--soft);font-size:.82rem}
.box,.good,.bad{border-radius:8px;padding:.6rem .9rem}
.box{margin:1.2rem 0;border-left:4px solid currentColor;overflow-wrap:anywhere}
.box ul{margin:.3rem 0 .1rem;padding-left:1.2rem}
.warnings{background:var(--warn-fill);color:var(--warn)}
.good{background:var(--good-fill);color:var(--good)}
.bad{background:var(--bad-fill);color:var(--bad);font-weight:600}
.views{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,460px),1fr));gap:1rem}
.views.flat{grid-template-columns:1fr}
figure{margin:0}
figure,article{background:var(--card);border:1px solid var(--line);border-radius:10px;padding:.8rem;min-width:0}
article{padding:1rem 1.1rem;margin:0 0 1rem}
.views article{margin:0}
figcaption{color:var(--soft);font-size:.85rem;text-align:center}
svg{display:block;width:100%;height:auto;font-size:12px;font-family:inherit}
svg text{fill:var(--soft)}
.middle{text-anchor:middle}.end{text-anchor:end}
svg .name{fill:var(--ink);font-size:12.5px}
.halo{paint-order:stroke;stroke:var(--card);stroke-width:3.5px;stroke-linejoin:round}
svg .of-body{fill:var(--accent)}svg .of-detector{fill:var(--detector)}svg .of-source{fill:var(--ink)}
.grid{stroke:var(--grid)}
.axis{stroke:var(--soft);fill:none;stroke-opacity:.7}
line.bar{stroke:var(--ink);stroke-width:1.2}
.body path,.sheet path{fill:none;stroke:var(--glass);stroke-width:1.1;stroke-linejoin:round}
.body .area{fill:var(--glass-fill);stroke-width:1.6}
.sheet .area{fill:var(--glass-fill);stroke:var(--soft);stroke-width:2}
.sheet path{stroke:var(--soft)}
.detector path{fill:none;stroke:var(--detector);stroke-width:1.8;stroke-dasharray:6 4}
.rays{isolation:isolate;opacity:.88}
.rays path{fill:none;stroke:currentColor;stroke-width:1;mix-blend-mode:multiply}
@media (prefers-color-scheme:dark){.rays path{mix-blend-mode:screen}}
.source{fill:var(--card);stroke:var(--ink);stroke-width:1.5}
.chart{max-width:640px}
.curve{fill:none;stroke:var(--accent);stroke-width:1.8;stroke-linejoin:round}
.dot{fill:var(--accent)}
.legend{display:flex;flex-wrap:wrap;gap:.2rem 1.3rem;align-items:center;font-size:.9rem;margin-top:.8rem}
.swatch{display:inline-block;width:.8em;height:.8em;border-radius:2px;background:currentColor;margin:0 .45em 0 0}
div.bar{display:flex;height:2.2rem;border-radius:6px;overflow:hidden;margin:1rem 0;background:var(--grid)}
.bar span{display:block;background:currentColor}
.detected{color:var(--detected)}.absorbed{color:var(--absorbed)}.escaped{color:var(--escaped)}.cut{color:var(--cut)}.error{color:var(--error)}
.scroll{overflow-x:auto;max-height:32rem}
table{border-collapse:collapse;font-size:.92rem;font-variant-numeric:tabular-nums}
th,td{padding:.28rem 1.4rem .28rem 0;text-align:left;border-bottom:1px solid var(--line);white-space:nowrap}
th{color:var(--soft);font-weight:550;font-size:.85rem}
td:first-child{white-space:normal;overflow-wrap:anywhere;min-width:7rem}
sup{line-height:0}
.beside{display:flex;flex-wrap:wrap;gap:1.2rem 2rem;align-items:flex-start;margin-bottom:.6rem}
.beside img{max-width:min(100%,460px);border-radius:6px}
.two{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,480px),1fr));gap:0 3rem}
dl{display:grid;grid-template-columns:max-content 1fr;gap:.25rem 1.2rem;margin:0;font-variant-numeric:tabular-nums}
dt{color:var(--soft)}dd{margin:0;overflow-wrap:anywhere}
details{margin:.8rem 0 0}
a{color:var(--accent)}
summary{cursor:pointer;color:var(--accent)}
pre{overflow-x:auto;font-size:.82rem;background:var(--card);border:1px solid var(--line);border-radius:8px;padding:.8rem}
@media print{main{max-width:none;padding:0}figure,article{break-inside:avoid}}
)css";

} // namespace sahl::report
