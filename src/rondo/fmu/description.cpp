// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fmu/description.hpp"

#include <fmt/format.h>

#include <cctype>

#include "rondo/core/version.hpp"

namespace rondo::fmu {
namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\n':
        out += "&#10;";
        break;
      default:
        out += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
    }
  return out;
}

/// Exponents of the units kg, m, s, rad.
struct Unit {
  const char* name;
  const char* base;
};

constexpr Unit units[] = {{"1", ""},
                          {"m", "m=\"1\""},
                          {"s", "s=\"1\""},
                          {"rad", "rad=\"1\""},
                          {"kg", "kg=\"1\""},
                          {"m2", "m=\"2\""},
                          {"m/s", "m=\"1\" s=\"-1\""},
                          {"rad/s", "rad=\"1\" s=\"-1\""},
                          {"N", "kg=\"1\" m=\"1\" s=\"-2\""},
                          {"N.m", "kg=\"1\" m=\"2\" s=\"-2\""},
                          {"kg.m2", "kg=\"1\" m=\"2\""}};

/// Causality, variability, initial: the combinations of the standard's table (2.2.7).
const char* kind_text(Kind kind) {
  switch (kind) {
    case Kind::parameter:
      return R"(causality="parameter" variability="fixed" initial="exact")";
    case Kind::calculated:
      return R"(causality="calculatedParameter" variability="fixed" initial="calculated")";
    case Kind::input:
      return R"(causality="input" variability="continuous")";
    case Kind::output:
      break;
  }
  return R"(causality="output" variability="continuous" initial="calculated")";
}

std::string real_text(const Variable& v, const Values& start) {
  std::string text = fmt::format("<Real unit=\"{}\"", v.unit);
  if (v.kind == Kind::parameter || v.kind == Kind::input) {
    if (!v.exclusive) text += fmt::format(" min=\"{}\"", v.least);
    text += fmt::format(" max=\"{}\" start=\"{}\"", v.most, start.*v.value);
  }
  return text + "/>";
}

std::string variables_text(const Description& d) {
  std::string text;
  std::size_t reference = 0;
  for (const Variable& v : variables(d.dimension))
    text += fmt::format(
        "    <ScalarVariable name=\"{}\" valueReference=\"{}\" {} description=\"{}\">\n"
        "      {}\n    </ScalarVariable>\n",
        v.name, reference++, kind_text(v.kind), escaped(v.description), real_text(v, d.start));
  return text;
}

/// Indices start at 1.
std::string unknowns(Dimension dimension, bool calculated) {
  std::string text;
  std::size_t index = 0;
  for (const Variable& v : variables(dimension)) {
    ++index;
    if (v.kind == Kind::output || (calculated && v.kind == Kind::calculated))
      text += fmt::format("      <Unknown index=\"{}\"/>\n", index);
  }
  return text;
}

const char* axes_text(Dimension dimension) {
  if (dimension == Dimension::plane) return "";
  return " Axes are those of ISO 8855: x along the heading of the wheel, y to the left, z up; they "
         "turn with the heading, but do not lean with the camber. Heights are along z, and the "
         "zeros of hub_x and hub_y are those of the ground of the case.";
}

}  // namespace

std::string identifier_of(const std::string& name) {
  std::string out;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    out += byte < 0x80 && std::isalnum(byte) != 0 ? c : '_';
  }
  if (out.empty() || std::isdigit(static_cast<unsigned char>(out[0])) != 0) out = "wheel_" + out;
  return out;
}

std::string model_description(const Description& d) {
  std::string unit_text;
  for (const Unit& unit : units)
    unit_text += fmt::format("    <Unit name=\"{}\"><BaseUnit{}{}/></Unit>\n", unit.name,
                             *unit.base == '\0' ? "" : " ", unit.base);
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<fmiModelDescription fmiVersion=\"2.0\" modelName=\"{0}\" guid=\"{1}\"\n"
      "    description=\"{2}\" version=\"{3}\" license=\"BSD-3-Clause\"\n"
      "    generationTool=\"rondo {3}\" variableNamingConvention=\"flat\">\n"
      "  <CoSimulation modelIdentifier=\"{0}\" canHandleVariableCommunicationStepSize=\"false\"\n"
      "      canGetAndSetFMUstate=\"true\" canSerializeFMUstate=\"true\"\n"
      "      canNotUseMemoryManagementFunctions=\"true\"/>\n"
      "  <UnitDefinitions>\n{4}  </UnitDefinitions>\n"
      "  <LogCategories>\n"
      "    <Category name=\"logStatusWarning\" description=\"what may not be as it seems\"/>\n"
      "    <Category name=\"logStatusError\" description=\"what was refused, or has failed\"/>\n"
      "  </LogCategories>\n"
      "  <DefaultExperiment startTime=\"0\" stepSize=\"{5}\"/>\n"
      "  <ModelVariables>\n{6}  </ModelVariables>\n"
      "  <ModelStructure>\n"
      "    <Outputs>\n{7}    </Outputs>\n"
      "    <InitialUnknowns>\n{8}    </InitialUnknowns>\n"
      "  </ModelStructure>\n"
      "</fmiModelDescription>\n",
      d.identifier, d.guid, escaped("Reduced wheel: " + d.title), version, unit_text, d.start.step,
      variables_text(d), unknowns(d.dimension, false), unknowns(d.dimension, true));
}

std::string index_page(const Description& d) {
  std::string rows;
  for (const Variable& v : variables(d.dimension))
    rows += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>\n", v.name, v.unit,
                        escaped(v.description));
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><meta charset=\"utf-8\"><title>{0}</title>\n"
      "<h1>{0}</h1>\n<p>{1}</p>\n"
      "<p>A wheel in a few modes, rolling on its ground: the motion of the hub goes in, what the "
      "tyre does to the hub comes out. The tyre as a rigid body is the hub's: add tyre_mass, its "
      "weight and tyre_inertia to those of the hub; the forces are without them. What an input "
      "has when a communication step is made, the hub has at its end. Parameters are set before "
      "initialisation is over.{4}</p>\n"
      "<table>\n<tr><th>variable</th><th>unit</th><th>meaning</th></tr>\n{2}</table>\n"
      "<p>Written by rondo {3}, whose docs/fmu.md says the rest. BSD 3-Clause License: "
      "<a href=\"LICENSE\">LICENSE</a>.</p>\n</html>\n",
      escaped(d.identifier), escaped(d.title), rows, version, axes_text(d.dimension));
}

}  // namespace rondo::fmu
