"use strict";

/** Builds a before/after slider from two images of the page; its range input supports the keyboard, too. */
function buildSlider(figure) {
    const stage = document.createElement("div");
    stage.className = "stage";
    const add = (element, className, text) => {
        const child = document.createElement(element);
        child.className = className;
        if (text) child.textContent = text;
        stage.append(child);
        return child;
    };
    const addPicture = (id, className) => {
        const original = document.getElementById(id);
        const picture = add("img", className);
        picture.width = original.width;
        picture.height = original.height;
        picture.alt = className === "over" ? "" : original.alt;
        picture.src = original.src;
    };
    addPicture(figure.dataset.left, "under");
    addPicture(figure.dataset.right, "over");
    const range = add("input", "");
    range.type = "range";
    range.max = 1000;
    range.value = 500;
    range.setAttribute("aria-label", figure.dataset.leftName + " left, " + figure.dataset.rightName + " right");
    add("span", "edge");
    add("span", "tag left", figure.dataset.leftName);
    add("span", "tag right", figure.dataset.rightName);
    range.addEventListener("input", () => stage.style.setProperty("--split", range.value / 10 + "%"));
    figure.prepend(stage);
    figure.hidden = false;
}

function buildCopyButton(command) {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = "Copy";
    button.addEventListener("click", async () => {
        try {
            await navigator.clipboard.writeText(command.querySelector("code").textContent);
            button.textContent = "Copied";
        } catch {
            button.textContent = "Not allowed";
        }
        setTimeout(() => (button.textContent = "Copy"), 1500);
    });
    command.append(button);
}

document.querySelectorAll("figure[data-left]").forEach(buildSlider);
if (navigator.clipboard) document.querySelectorAll(".command").forEach(buildCopyButton);
