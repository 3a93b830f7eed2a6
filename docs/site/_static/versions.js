// The versions that lie beside this one: ../versions.json, as docs/site/keep_version.py writes it.
document.addEventListener("DOMContentLoaded", async () => {
  const choice = document.getElementById("site-version");
  if (!choice || location.protocol === "file:") return;
  const root = new URL((choice.dataset.root || "./").replace(/\/?$/, "/"), location.href);
  let versions = [];
  try {
    const answer = await fetch(new URL("../versions.json", root));
    if (!answer.ok) return;
    versions = await answer.json();
  } catch {
    return;
  }
  if (!versions.some((name) => name === choice.dataset.version)) return;
  choice.replaceChildren(
    ...versions.map((name) => new Option(name, name, false, name === choice.dataset.version)),
  );
  choice.disabled = versions.length < 2;
  choice.addEventListener("change", () => {
    location.href = new URL(`../${choice.value}/index.html`, root);
  });
});
