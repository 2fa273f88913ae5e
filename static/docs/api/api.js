// Shows openapi.json as a page, without anything from elsewhere: it works offline.

const METHODS = ["get", "post", "put", "patch", "delete"];
const DEEPEST = 6;

const specification = await (await fetch("openapi.json")).json();
document.getElementById("about").textContent =
  `${specification.info.description} Version ${specification.info.version}.`;
const endpoints = listEndpoints(specification.paths);
render("");
document.getElementById("find").addEventListener("input", (event) => render(event.target.value));

function listEndpoints(paths) {
  return Object.entries(paths).flatMap(([path, operations]) =>
    METHODS.filter((method) => method in operations).map((method) => ({
      path,
      method,
      tag: operations[method].tags?.[0] ?? "other",
      ...operations[method],
    })));
}

function render(query) {
  const words = query.toLowerCase().split(/\s+/).filter(Boolean);
  const found = endpoints.filter((endpoint) => {
    const text = `${endpoint.method} ${endpoint.path} ${endpoint.summary}`.toLowerCase();
    return words.every((word) => text.includes(word));
  });
  const sections = [...new Set(found.map((endpoint) => endpoint.tag))].map((tag) =>
    element("section", {}, element("h2", {}, tag),
      ...found.filter((endpoint) => endpoint.tag === tag).map(card)));
  document.getElementById("endpoints").replaceChildren(
    ...(sections.length ? sections : [element("p", {}, "No endpoint has all of these words.")]));
}

function card(endpoint) {
  const summary = element("summary", {},
    element("span", { className: `method ${endpoint.method}` }, endpoint.method),
    element("span", { className: "path" }, endpoint.path),
    element("span", { className: "about" }, endpoint.summary ?? ""));
  return element("details", {}, summary, element("div", { className: "body" },
    element("p", {}, endpoint.description ?? ""),
    ...parameters(endpoint.parameters ?? []),
    ...content("Body", endpoint.requestBody?.content ?? {}),
    ...Object.entries(endpoint.responses ?? {}).flatMap(([status, response]) =>
      response.content || status < 300
        ? [element("h3", {}, `${status} ${response.description}`), ...content("", response.content ?? {})]
        : [])));
}

function parameters(list) {
  if (list.length === 0) return [];
  const rows = list.map((parameter) => element("tr", {},
    element("td", {}, element("code", {}, parameter.name)),
    element("td", {}, `${parameter.in}, ${typeName(parameter.schema ?? {})}`),
    element("td", {}, parameter.description ?? "")));
  return [element("h3", {}, "Parameters"), element("table", {}, ...rows)];
}

function content(title, types) {
  return Object.entries(types).flatMap(([type, { schema }]) => [
    ...(title ? [element("h3", {}, `${title} (${type})`)] : []),
    element("pre", {}, schema ? example(schema, 0) : type),
  ]);
}

// A schema as JSON with types in place of values and descriptions as comments.
function example(schema, depth) {
  const plain = resolve(schema);
  if (plain.type === "array") return `[${example(plain.items ?? {}, depth)}, …]`;
  if (!plain.properties || depth > DEEPEST) return typeName(plain);
  const required = new Set(plain.required ?? []);
  const pad = "  ".repeat(depth + 1);
  const lines = Object.entries(plain.properties).map(([name, property]) => {
    const note = [required.has(name) ? "" : "optional", property.description ?? ""]
      .filter(Boolean).join(": ");
    return `${pad}"${name}": ${example(property, depth + 1)}${note ? `  // ${note}` : ""}`;
  });
  return `{\n${lines.join("\n")}\n${"  ".repeat(depth)}}`;
}

function resolve(schema) {
  if (schema.$ref) return resolve(specification.components.schemas[schema.$ref.split("/").pop()]);
  return schema;
}

function typeName(schema) {
  const plain = resolve(schema);
  if (plain.enum) return plain.enum.map((value) => JSON.stringify(value)).join(" | ");
  if (plain.const !== undefined) return JSON.stringify(plain.const);
  if (plain.anyOf) return plain.anyOf.map(typeName).join(" | ");
  if (plain.contentMediaType) return "file";
  return plain.format ? `${plain.type} (${plain.format})` : plain.type ?? "anything";
}

function element(name, properties, ...children) {
  const node = Object.assign(document.createElement(name), properties);
  node.append(...children);
  return node;
}
