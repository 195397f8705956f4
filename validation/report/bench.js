"use strict";

/** The plots of a benchmark's page, from the JSON embedded in the page. */
(() => {
    const source = document.getElementById("bench-data");
    if (!source || typeof Chart === "undefined") return;
    const data = JSON.parse(source.textContent);
    const shapes = ["circle", "triangle", "rect", "rectRot", "star"];
    const kinds = [...new Set(data.groups.flatMap((group) => group.points.map((point) => point.mark)))];
    const isExact = (kind) => kind === "exact" || kind === "traced"; // a circle
    kinds.sort((a, b) => isExact(b) - isExact(a));
    const redraws = [];

    const variable = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
    const colourOf = (technique) => variable("--technique-" + data.techniques.indexOf(technique));
    const shapeOf = (kind) => shapes[Math.max(0, kinds.indexOf(kind)) % shapes.length];
    const isNarrow = () => window.innerWidth < 600;

    const superscript = (number) =>
        String(number).replace(/./g, (c) => (c === "-" ? "\u207b" : "\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079"[c]));

    /** 0.012, 1.2, 120 or 1.2 x 10^6. */
    function plain(value) {
        if (value === 0) return "0";
        const exponent = Math.floor(Math.log10(Math.abs(value)) + 1e-9);
        if (exponent >= -2 && exponent <= 4) return String(+value.toPrecision(3));
        const mantissa = +(value / 10 ** exponent).toPrecision(2);
        return (mantissa === 1 ? "" : mantissa + "\u202f\u00d7\u202f") + "10" + superscript(exponent);
    }

    /** Ticks at powers of ten, and where few of them lie on the axis also at 2 and 5 times them. */
    function logTicks(axis) {
        const decades = Math.log10(axis.max / axis.min);
        const steps = decades > 2.5 ? [1] : decades > 0.7 ? [1, 2, 5] : [1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9];
        const every = Math.max(1, Math.ceil(decades / 8));
        const ticks = [];
        for (let e = Math.floor(Math.log10(axis.min)) - 1; e <= Math.ceil(Math.log10(axis.max)); ++e) {
            if (e % every !== 0) continue;
            for (const step of steps) {
                const value = step * 10 ** e;
                if (value >= axis.min * 0.999 && value <= axis.max * 1.001) ticks.push({ value });
            }
        }
        // One tick if all measured values are equal: their padded range is a tenth of a decade.
        axis.ticks = ticks.length && decades > 0.11 ? ticks : [{ value: Math.sqrt(axis.min * axis.max) }];
    }

    /** A count: exact, with thousands separators, as long as it is short. */
    const counted = (value) =>
        Number.isInteger(value) && value < 1e7 ? value.toLocaleString("en-US") : plain(value);

    /** Ticks at measured values, as many as fit with their labels. */
    function measuredTicks(values) {
        const sorted = [...new Set(values)].sort((a, b) => a - b);
        return (axis) => {
            const share = (value) => Math.log(value / axis.min) / Math.log(axis.max / axis.min);
            const leastGap = isNarrow() ? 0.16 : 0.07;
            const ticks = [];
            for (const value of sorted) {
                if (!ticks.length || share(value) - share(ticks[ticks.length - 1].value) >= leastGap) ticks.push({ value });
            }
            axis.ticks = ticks;
        };
    }

    function logAxis(title, more) {
        return {
            type: "logarithmic",
            title: { display: true, text: title, color: variable("--soft") },
            grid: { color: variable("--rule"), borderColor: variable("--rule") },
            afterBuildTicks: logTicks,
            ticks: { color: variable("--soft"), autoSkip: false, maxRotation: 0, callback: plain },
            ...more,
        };
    }

    /** The range of the values, padded on both sides by a fraction of its length. */
    function padded(values, share) {
        const low = Math.log10(Math.min(...values)), high = Math.log10(Math.max(...values));
        const room = Math.max((high - low) * share, 0.05);
        return { min: 10 ** (low - room), max: 10 ** (high + room) };
    }

    function commonOptions(tooltip) {
        return {
            animation: false,
            responsive: true,
            maintainAspectRatio: false,
            interaction: { mode: "nearest", intersect: false, axis: "xy" },
            plugins: {
                legend: {
                    position: "bottom",
                    labels: { color: variable("--ink"), usePointStyle: true, boxWidth: 7, boxHeight: 7, padding: isNarrow() ? 9 : 16 },
                },
                tooltip: { callbacks: tooltip, displayColors: false },
            },
        };
    }

    /** Draws a plot now and whenever the returned function is called; data-points of the canvas is its number of marks. */
    function plot(canvasId, configure, drawn = () => {}) {
        const canvas = document.getElementById(canvasId);
        let chart = null;
        const draw = () => {
            if (chart) chart.destroy();
            Chart.defaults.font.family = variable("--sans");
            Chart.defaults.font.size = isNarrow() ? 11 : 13;
            chart = new Chart(canvas, configure());
            const shown = chart.data.datasets.map((set, i) => (set.marks ? chart.getDatasetMeta(i).data.length : 0));
            canvas.dataset.points = shown.reduce((sum, count) => sum + count, 0);
            drawn(chart);
        };
        draw();
        redraws.push(draw);
        return draw;
    }

    /** Draws the names of labelled marks beside them. */
    const names = {
        id: "names",
        afterDatasetsDraw(chart) {
            const context = chart.ctx, area = chart.chartArea;
            context.save();
            context.font = "600 " + Chart.defaults.font.size + "px " + Chart.defaults.font.family;
            context.fillStyle = variable("--ink");
            context.strokeStyle = variable("--card"); // outlines letters over lines and marks
            context.lineWidth = 4;
            context.lineJoin = "round";
            context.textBaseline = "middle";
            const marks = chart.data.datasets.flatMap((set, i) =>
                set.marks && chart.isDatasetVisible(i) ? chart.getDatasetMeta(i).data : []);
            chart.data.datasets.forEach((set, i) => {
                if (!chart.isDatasetVisible(i)) return;
                chart.getDatasetMeta(i).data.forEach((mark, j) => {
                    const label = set.data[j].label;
                    if (!label) return;
                    // The first place around the mark that overlaps the fewest marks and no edge.
                    const width = context.measureText(label).width, reach = 18, half = Chart.defaults.font.size / 2 + 2;
                    const places = [
                        { x: mark.x - width / 2, y: mark.y - reach - half },
                        { x: mark.x - width / 2, y: mark.y + reach + half },
                        { x: mark.x + 12, y: mark.y - reach - half },
                        { x: mark.x + 12, y: mark.y + reach + half },
                        { x: mark.x - 12 - width, y: mark.y - reach - half },
                        { x: mark.x + reach, y: mark.y },
                        { x: mark.x - reach - width, y: mark.y },
                    ];
                    const cost = ({ x, y }) =>
                        marks.filter((other) => other.x > x - 8 && other.x < x + width + 8 && Math.abs(other.y - y) < half + 7)
                            .length +
                        1000 * (x < area.left || x + width > area.right || y - half < area.top || y + half > area.bottom);
                    const place = places.reduce((best, tried) => (cost(tried) < cost(best) ? tried : best));
                    context.strokeText(label, place.x, place.y);
                    context.fillText(label, place.x, place.y);
                });
            });
            context.restore();
        },
    };

    function frontConfiguration(group) {
        const measured = group.points.filter((point) => point.relMse !== null);
        const positive = measured.map((point) => point.relMse).filter((value) => value > 0);
        // A logarithmic axis cannot show 0: images without error lie on its lower end.
        const zero = positive.length ? 10 ** (Math.floor(Math.log10(Math.min(...positive))) - 1) : 1e-12;
        const place = (point) => ({ x: point.ms, y: point.relMse > 0 ? point.relMse : zero, point });
        const datasets = data.techniques
            .filter((technique) => measured.some((point) => point.technique === technique))
            .map((technique) => {
                const own = measured.filter((point) => point.technique === technique);
                return {
                    label: technique,
                    marks: true,
                    data: own.map(place),
                    backgroundColor: colourOf(technique),
                    borderColor: variable("--card"),
                    borderWidth: 1,
                    pointRadius: own.map((point) => (point.front ? 8 : 6)),
                    pointHoverRadius: 9,
                    pointStyle: own.map((point) => shapeOf(point.mark)),
                };
            });
        const front = measured.filter((point) => point.front).sort((a, b) => a.ms - b.ms || b.relMse - a.relMse);
        if (front.length > 1) {
            datasets.push({
                label: "front",
                type: "line",
                data: front.map(place),
                borderColor: variable("--soft"),
                borderWidth: 1.5,
                borderDash: [5, 4],
                pointRadius: 0,
                pointHitRadius: 0,
                pointStyle: "line",
                order: 1,
            });
        }
        const taken = measured.filter((point) => point.best);
        if (taken.length) {
            datasets.push({
                label: "take",
                data: taken.map((point) => ({ ...place(point), label: point.technique })),
                backgroundColor: "transparent",
                borderColor: variable("--ink"),
                borderWidth: 2,
                pointRadius: 12,
                pointHitRadius: 0,
                pointStyle: "circle",
            });
        }
        // Legend entries for the meaning of shapes have no marks.
        const shown = kinds.filter((kind) => measured.some((point) => point.mark === kind));
        if (shown.length > 1) {
            for (const kind of shown) {
                datasets.push({
                    label: data.markKind === "layout" ? kind + " layout" : data.markKind + " " + kind,
                    isKey: true,
                    data: [],
                    backgroundColor: "transparent",
                    borderColor: variable("--soft"),
                    pointStyle: shapeOf(kind),
                });
            }
        }
        const options = commonOptions({
            title: (items) => items[0].raw.point.name,
            label: (item) => {
                const point = item.raw.point;
                const lines = [
                    plain(point.ms) + " ms a frame, p95 " + plain(point.p95),
                    "relMSE " + plain(point.relMse) + ", p99 rel " + (point.p99Rel === null ? "\u2013" : plain(point.p99Rel)),
                ];
                if (point.toLowerBound !== null) lines.push(plain(point.toLowerBound) + " times the lower bound");
                if (point.toLitLowerBound !== null) lines.push(plain(point.toLitLowerBound) + " times that of lit pairs");
                return lines;
            },
        });
        options.plugins.tooltip.filter = (item, i) => i === 0;
        options.plugins.legend.onClick = (event, item, legend) => {
            if (!datasets[item.datasetIndex].isKey) Chart.defaults.plugins.legend.onClick.call(legend, event, item, legend);
        };
        const heights = measured.map((point) => place(point).y);
        const vertical = heights.length ? padded(heights, 0.12) : {};
        options.scales = {
            x: logAxis("ms a frame", measured.length ? padded(measured.map((point) => point.ms), 0.06) : {}),
            y: logAxis("relMSE against " + group.truth, vertical),
        };
        options.scales.y.ticks.callback = (value) => (value <= zero * 1.01 ? "0" : plain(value));
        return { type: "scatter", data: { datasets }, options, plugins: [names] };
    }

    const groupChoice = document.getElementById("front-group");
    const drawFront = plot("front-plot", () => frontConfiguration(data.groups[groupChoice.value]));
    groupChoice.addEventListener("change", drawFront);

    const kManyCurves = 16; // with more curves, only those of one mark are visible at first
    const dashes = [[], [9, 4], [3, 3], [12, 3, 3, 3], [1.5, 2.5], [6, 2, 1.5, 2, 1.5, 2]];
    /** How far a technique's colour is mixed with the ink's, or below 0 with the card's, per culling method. */
    const shades = [0, 0.35, -0.35, 0.55, -0.55, 0.2];

    function mixed(colour, other, share) {
        const channels = (code) => [1, 3, 5].map((i) => parseInt(code.slice(i, i + 2), 16));
        const to = channels(other);
        return "rgb(" + channels(colour).map((value, i) => Math.round(value + (to[i] - value) * share)).join(" ") + ")";
    }

    const cullingOf = (curve) => curve.name.split(", ").slice(1).filter((part) => part !== curve.mark).join(", ");

    /** A colour for each technique, and a shade and dashes for each of its culling methods. */
    function curveStyles(curves) {
        return curves.map((curve) => {
            const same = curves.filter((other) => other.technique === curve.technique);
            const i = [...new Set(same.map(cullingOf))].indexOf(cullingOf(curve)) % shades.length;
            const towards = variable(shades[i] < 0 ? "--card" : "--ink");
            return { colour: mixed(colourOf(curve.technique), towards, Math.abs(shades[i])), dash: dashes[i] };
        });
    }

    const marks = {
        circle: '<circle r="4" />',
        triangle: '<path d="M0-5 4.5 3.5H-4.5Z" />',
        rect: '<path d="M-3.5-3.5h7v7h-7z" />',
        rectRot: '<path d="M0-5 5 0 0 5-5 0Z" />',
        star: '<path d="M-5 0H5M0-5V5M-3.5-3.5 3.5 3.5M-3.5 3.5 3.5-3.5" />',
    };

    /** A button per curve, below one per technique: a legend on the canvas cannot fit so many names. */
    function buildLegend(chart, legend) {
        const sets = chart.data.datasets.map((set, i) => ({ ...set, i }));
        const buttons = [];
        const update = () => {
            chart.update();
            for (const { button, of } of buttons)
                button.setAttribute("aria-pressed", of.some((set) => chart.isDatasetVisible(set.i)));
        };
        const add = (place, of, className, text, swatch = "") => {
            const button = document.createElement("button");
            button.type = "button";
            button.className = className;
            button.innerHTML = swatch;
            button.append(text);
            button.addEventListener("click", () => {
                const isVisible = of.every((set) => chart.isDatasetVisible(set.i));
                for (const set of of) chart.setDatasetVisibility(set.i, !isVisible);
                update();
            });
            place.append(button);
            buttons.push({ button, of });
        };
        const swatchOf = (set) =>
            `<svg viewBox="-24 -8 48 16" stroke="${set.borderColor}" stroke-width="2" fill="${set.borderColor}">` +
            `<path d="M-24 0H24" stroke-dasharray="${set.borderDash.join(" ")}" />${marks[set.pointStyle]}</svg>`;
        const note = document.createElement("p");
        note.append("Colour shows the technique, shade and dashes its culling method, and the mark the " + data.markKind + ". ");
        const shown = kinds.filter((kind) => sets.some((set) => set.curve.mark === kind));
        if (shown.length > 1) {
            note.append("Show or hide all of ");
            for (const kind of shown) {
                add(note, sets.filter((set) => set.curve.mark === kind), "", kind);
                note.append(" ");
            }
        }
        const columns = document.createElement("div");
        columns.className = "techniques";
        for (const technique of new Set(sets.map((set) => set.curve.technique))) {
            const own = sets.filter((set) => set.curve.technique === technique);
            const column = document.createElement("div");
            if (own.length > 1) add(column, own, "whole-technique", technique);
            const nameOf = (set) => (own.length > 1 ? set.label.slice(technique.length + 2) : set.label);
            for (const set of own) add(column, [set], "curve", nameOf(set), swatchOf(set));
            columns.append(column);
        }
        legend.replaceChildren(note, columns);
        update();
    }

    const scalingChoice = document.getElementById("scaling-curves");
    if (scalingChoice) {
        const titleOf = (curve) =>
            curve.scene + ": time against " + curve.quantity + (curve.held ? " at " + curve.held : "");
        const titles = [...new Set(data.curves.map(titleOf))];
        for (const title of titles) scalingChoice.add(new Option(title, title));
        scalingChoice.closest(".controls").hidden = titles.length < 2;
        const configure = () => {
            const curves = data.curves.filter((curve) => titleOf(curve) === scalingChoice.value);
            const styles = curveStyles(curves);
            const datasets = curves.map((curve, i) => ({
                label: curve.name + (curve.growth ? " (" + curve.growth + ")" : ""),
                curve,
                hidden: curves.length > kManyCurves && curve.mark !== curves[0].mark,
                marks: true,
                data: curve.x.map((x, i) => ({ x, y: curve.ms[i] })),
                borderColor: styles[i].colour,
                backgroundColor: styles[i].colour,
                borderWidth: 2,
                borderDash: styles[i].dash,
                pointStyle: shapeOf(curve.mark),
                pointRadius: 4,
                pointHoverRadius: 7,
            }));
            const options = commonOptions({
                title: (items) => items[0].dataset.label,
                label: (item) => counted(item.raw.x) + " " + curves[0].quantity + ": " + plain(item.raw.y) + " ms",
            });
            options.plugins.tooltip.filter = (item, i) => i === 0;
            options.plugins.legend.display = false;
            const measured = curves.flatMap((curve) => curve.x);
            options.scales = {
                x: logAxis(curves[0].quantity, { ...padded(measured, 0.04), afterBuildTicks: measuredTicks(measured) }),
                y: logAxis("ms a frame", padded(curves.flatMap((curve) => curve.ms), 0.08)),
            };
            options.scales.x.ticks.callback = counted;
            return { type: "line", data: { datasets }, options };
        };
        const legend = document.createElement("div");
        legend.className = "legend";
        document.getElementById("scaling-plot").parentElement.after(legend);
        const drawScaling = plot("scaling-plot", configure, (chart) => buildLegend(chart, legend));
        scalingChoice.addEventListener("change", drawScaling);
    }

    /** A slider between any two images of a group. */
    document.querySelectorAll(".viewer").forEach((viewer) => {
        const pictures = [...viewer.querySelectorAll("img.picture")];
        const place = viewer.querySelector(".stage-place");
        const choice = (label, selected) => {
            const select = document.createElement("select");
            pictures.forEach((picture, i) => select.add(new Option(picture.dataset.name, i, false, i === selected)));
            const element = document.createElement("label");
            element.append(label + " ", select);
            return { element, select };
        };
        const left = choice("Left", 0), right = choice("Right", pictures.length - 1);
        const controls = document.createElement("p");
        controls.className = "controls";
        controls.append(left.element, right.element);
        const show = () => {
            const figure = document.createElement("figure");
            for (const [side, chosen] of [["left", left], ["right", right]]) {
                const picture = pictures[chosen.select.value];
                figure.dataset[side] = picture.id;
                figure.dataset[side + "Name"] = picture.dataset.name;
            }
            buildSlider(figure);
            place.replaceChildren(controls, figure);
        };
        left.select.addEventListener("change", show);
        right.select.addEventListener("change", show);
        show();
    });

    window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => redraws.forEach((draw) => draw()));
})();
