// What a reader can do with the report: pick effects and a scene, dim what has another value, and read a point's name.
const picked = id => document.getElementById(id);

/// Shows the scatter of the effects and the scene picked, and dims the points that have another value.
function refresh() {
  const feature = picked("feature").value;
  const value = picked("value").value;
  let shown = 0;
  for (const figure of document.querySelectorAll("#scatters figure")) {
    figure.hidden = figure.dataset.effects !== picked("effects").value || figure.dataset.scene !== picked("scene").value;
    if (figure.hidden) continue;
    for (const point of figure.querySelectorAll(".point")) {
      const values = point.dataset.values.split(" ");
      const matches = feature === "" || value === "" || values[Number(feature)] === value;
      point.classList.toggle("dimmed", !matches);
      point.setAttribute("tabindex", matches ? "0" : "-1");
      if (matches) ++shown;
    }
  }
  picked("shown").textContent = shown + " permutations";
}

/// Offers the values of the feature picked.
function offerValues() {
  const select = picked("value");
  select.replaceChildren(new Option("anything", ""));
  const feature = picked("feature").value;
  if (feature !== "") features[Number(feature)].values.forEach((name, index) => select.add(new Option(name, String(index))));
  refresh();
}

function showTip(point) {
  const tip = picked("tip");
  tip.textContent = point.dataset.tip;
  tip.hidden = false;
  const box = point.getBoundingClientRect();
  const left = Math.min(box.right + 10, document.documentElement.clientWidth - tip.offsetWidth - 10);
  tip.style.left = Math.max(0, left) + window.scrollX + "px";
  tip.style.top = box.bottom + 8 + window.scrollY + "px";
}

const hideTip = () => { picked("tip").hidden = true; };

for (const id of ["effects", "scene", "value"]) picked(id).addEventListener("change", refresh);
picked("feature").addEventListener("change", offerValues);
for (const point of document.querySelectorAll(".point")) {
  const title = point.querySelector("title");  // the browser would show it as a second tip
  point.dataset.tip = title.textContent;
  point.setAttribute("aria-label", title.textContent);
  title.remove();
  point.addEventListener("mouseenter", () => showTip(point));
  point.addEventListener("focus", () => showTip(point));
  point.addEventListener("mouseleave", hideTip);
  point.addEventListener("blur", hideTip);
}
offerValues();
