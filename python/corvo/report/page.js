// SPDX-License-Identifier: MIT
// Draws the plots of the page one after another, in the colors of the page.
"use strict";
(() => {
  const figures = JSON.parse(document.getElementById("figures").textContent);
  const dark = window.matchMedia("(prefers-color-scheme: dark)");
  const coarse = window.matchMedia("(pointer: coarse)").matches;
  const narrow = window.matchMedia("(max-width: 40rem)").matches;

  const colorOf = (name) =>
    getComputedStyle(document.documentElement).getPropertyValue(name).trim();

  // The axes of a layout, also those of a scene.
  const axesOf = (layout) =>
    Object.keys(layout.scene || layout).filter((name) => /^[xyz]axis\d*$/.test(name))
      .map((name) => (layout.scene ? "scene." : "") + name);

  // Colors by the paths of a layout's attributes.
  const colors = (layout) => {
    const changes = { "font.color": colorOf("--text"), "hoverlabel.bgcolor": colorOf("--panel") };
    changes["hoverlabel.font.color"] = colorOf("--text");
    for (const axis of axesOf(layout)) {
      if (!layout.scene) changes[axis + ".automargin"] = true;
      changes[axis + ".gridcolor"] = colorOf("--grid");
      changes[axis + ".zerolinecolor"] = colorOf("--line");
      changes[axis + ".linecolor"] = colorOf("--line");
    }
    return changes;
  };

  const set = (object, path, value) => {
    const keys = path.split("."), last = keys.pop();
    for (const key of keys) object = object[key] ??= {};
    object[last] = value;
  };

  const complete = (layout) => {
    const result = { ...layout, ...common(layout) };
    for (const [path, value] of Object.entries(colors(layout))) set(result, path, value);
    // A narrow screen shows less of a scene from the same place.
    if (layout.scene && narrow) {
      for (const axis of "xyz") result.scene.camera.eye[axis] *= 1.6;
    }
    return result;
  };

  const common = (layout) => ({
    paper_bgcolor: "rgba(0,0,0,0)",
    plot_bgcolor: "rgba(0,0,0,0)",
    font: { family: "system-ui, sans-serif", size: narrow ? 11 : 13 },
    margin: layout.scene ? { l: 0, r: 0, t: 10, b: 0 } : { l: narrow ? 48 : 64, r: 12, t: 24, b: 48 },
    legend: { orientation: "h", x: 0, y: 1.02, yanchor: "bottom", tracegroupgap: 0 },
    // A finger scrolls the page.
    dragmode: layout.scene ? "orbit" : coarse ? false : "zoom",
  });

  // The buttons are named one by one: plotly.js has another one that uploads the plot.
  const buttons = (layout) => layout.scene
    ? [["orbitRotation", "pan3d", "zoom3d"], ["resetCameraDefault3d"], ["toImage"]]
    : [["zoom2d", "pan2d"], ["zoomIn2d", "zoomOut2d", "resetScale2d"], ["toImage"]];

  const config = (id, layout) => ({
    responsive: true,
    displaylogo: false,
    displayModeBar: coarse ? false : "hover",
    modeBarButtons: buttons(layout),
    showSendToCloud: false,
    plotlyServerURL: "",
    toImageButtonOptions: { filename: id },
  });

  const draw = async () => {
    // Plots in three dimensions take longest, so they come last.
    const order = [...figures].sort((a, b) => ("scene" in a.layout) - ("scene" in b.layout));
    for (const { id, data, layout } of order) {
      const plot = document.getElementById(id);
      await Plotly.newPlot(plot, data, complete(layout), config(id, layout));
      for (const drawing of plot.querySelectorAll("svg.main-svg, canvas")) {
        drawing.setAttribute("aria-hidden", "true");  // Its description is the label of the plot.
      }
      await new Promise((resolve) => setTimeout(resolve));  // The page stays responsive.
    }
    document.documentElement.dataset.drawn = figures.length;
  };

  dark.addEventListener("change", () => {
    for (const { id, layout } of figures) Plotly.relayout(id, colors(layout));
  });
  draw();
})();
