(function () {
  "use strict";
  const pair = /M(-?[\d.]+) (-?[\d.]+)/g;
  const digits = function (value) { return Number(value.toPrecision(4)).toString().replace("-", "−"); };
  document.querySelectorAll("svg.loop, svg.overlay, svg.graph").forEach(function (svg) {
    svg.classList.add("live");
    svg.querySelectorAll(".key").forEach(function (key) {
      const names = "." + key.dataset.key.split(" ").join(".");
      key.addEventListener("click", function () {
        const out = key.classList.toggle("out");
        svg.querySelectorAll(".series " + names).forEach(function (series) { series.classList.toggle("hidden", out); });
      });
    });
    const readout = svg.parentElement.querySelector(".readout");
    const group = svg.querySelector(".series");
    const map = svg.querySelector(".frame").dataset.map.split(" ").map(Number);
    const logs = svg.querySelector(".frame").dataset.log || "";
    const value = function (axis, at) {
      const found = axis === "x" ? map[0] + map[1] * at : map[2] + map[3] * at;
      return digits(logs.includes(axis) ? Math.pow(10, found) : found);
    };
    const residuals = Array.from(svg.querySelectorAll(".residuals path"));
    const residualMap = residuals.length ? svg.querySelectorAll(".frame")[1].dataset.map.split(" ").map(Number) : null;
    const read = function (path) {
      const found = path.getAttribute("d").replace(/L/g, "M").matchAll(pair);
      return Array.from(found, function (m) { return [Number(m[1]), Number(m[2])]; });
    };
    let all = null;
    const load = function () {
      all = Array.from(group.querySelectorAll("[data-label]"), function (path, index) {
        const below = residuals[index] ? read(residuals[index]) : [];
        return { path: path, points: read(path), below: below };
      });
    };
    const cursor = document.createElementNS(svg.namespaceURI, "circle");
    cursor.setAttribute("r", "5.5");
    cursor.setAttribute("class", "cursor hidden");
    svg.appendChild(cursor);
    svg.addEventListener("pointermove", function (event) {
      if (all === null) { load(); }
      const place = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
      let best = { far: 24 };
      all.forEach(function (series) {
        if (series.path.classList.contains("hidden")) { return; }
        series.points.forEach(function (at, index) {
          const far = Math.hypot(at[0] - place.x, at[1] - place.y);
          if (best.far > far) { best = { far: far, at: at, index: index, series: series }; }
        });
      });
      cursor.classList.toggle("hidden", !best.at);
      if (!best.at) { readout.textContent = ""; return; }
      cursor.setAttribute("cx", best.at[0]);
      cursor.setAttribute("cy", best.at[1]);
      const data = group.dataset;
      let text = best.series.path.dataset.label
        + " · " + data.x + " " + value("x", best.at[0]) + " " + data.xUnit
        + " · " + data.y + " " + value("y", best.at[1]) + " " + data.yUnit;
      if (best.series.below.length === best.series.points.length) {
        text += " · residual " + digits(residualMap[2] + residualMap[3] * best.series.below[best.index][1]) + " %";
      }
      readout.textContent = text;
    });
    svg.addEventListener("pointerleave", function () {
      readout.textContent = "";
      cursor.classList.add("hidden");
    });
  });
}());
