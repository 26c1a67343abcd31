// SPDX-License-Identifier: BSD-3-Clause
// Curves by plotly.js in the colours of the page.
"use strict";

rondo.DASHES = ["solid", "dash", "dot", "dashdot", "longdash", "5px,2px,1px,2px"];

rondo.line = (n) => ({color: rondo.colour("curve" + n % 6), dash: rondo.DASHES[Math.floor(n / 6) % 6], width: 1.6});

rondo.layout = (x, y, options = {}) => {
  const grid = rondo.colour("grid"), text = rondo.colour("text");
  const axis = (title, log) => ({title: {text: title, standoff: 8}, type: log ? "log" : "linear", gridcolor: grid,
                                 zerolinecolor: grid, linecolor: grid, automargin: true,
                                 exponentformat: "SI", nticks: 8});
  return {xaxis: axis(x, options.xLog), yaxis: axis(y, options.yLog), paper_bgcolor: "rgba(0,0,0,0)",
          plot_bgcolor: "rgba(0,0,0,0)", font: {color: text, family: "system-ui, sans-serif", size: 13},
          modebar: {bgcolor: "rgba(0,0,0,0)", color: rondo.colour("soft"), activecolor: rondo.colour("link")},
          margin: {l: 60, r: 12, t: 32, b: 48}, hovermode: "closest", showlegend: options.legend !== false,
          legend: {orientation: "h", y: -0.22, yanchor: "top"}, colorway: [text],
          // A finger scrolls the page; the buttons above the curves zoom.
          dragmode: window.matchMedia("(pointer: coarse)").matches ? false : "zoom"};
};

// The buttons by name: of its own plotly.js adds one that sends the chart to its makers.
rondo.settings = {responsive: true, displaylogo: false, scrollZoom: false, plotlyServerURL: "", showSendToCloud: false,
                  modeBarButtons: [["toImage", "zoom2d", "pan2d", "zoomIn2d", "zoomOut2d", "resetScale2d"]]};

rondo.Chart = class {
  static async make(place) {
    const chart = new rondo.Chart(), data = rondo.data(place.dataset.source);
    chart.place = place;
    chart.data = data;
    chart.traces = [];
    for (const trace of data.traces)
      chart.traces.push({name: trace.name, x: Array.from(await rondo.unpack(trace.x)), y: Array.from(await rondo.unpack(trace.y))});
    chart.draw();
    rondo.dark.addEventListener("change", () => chart.draw());
    return chart;
  }

  draw() {
    const d = this.data, few = this.traces.every((trace) => trace.x.length <= 60);
    const lines = this.traces.map((trace, n) => ({...trace, type: "scatter", mode: few ? "lines+markers" : "lines",
                                                  marker: {size: 5}, line: rondo.line(n),
                                                  hovertemplate: "%{x:.5g}, %{y:.5g}<extra>" + rondo.plain(trace.name) + "</extra>"}));
    lines.forEach((line) => { line.name = rondo.plain(line.name); });
    const legend = this.traces.length > 1;
    const layout = rondo.layout(rondo.plain(d.x), rondo.plain(d.y), {xLog: d.x_log, yLog: d.y_log, legend});
    return Plotly.react(this.place, lines, layout, rondo.settings);
  }
};

// plotly reads some tags in its texts; names of the user are to be seen as they are.
rondo.plain = (text) => String(text).replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/>/g, "&gt;");

rondo.charts = [];
// As they come near to what is seen: a page of many opens at once.
rondo.watch = new IntersectionObserver((seen) => {
  for (const {isIntersecting, target} of seen) {
    if (!isIntersecting) continue;
    rondo.watch.unobserve(target);
    target.replaceChildren();
    rondo.Chart.make(target).then((chart) => rondo.charts.push(chart), (reason) => rondo.refuse(target, reason.message));
  }
}, {rootMargin: "600px"});
for (const place of document.querySelectorAll(".plot")) rondo.watch.observe(place);
window.addEventListener("beforeprint", () => {
  for (const place of document.querySelectorAll(".plot"))
    if (place.data) Plotly.Plots.resize(place);
});
