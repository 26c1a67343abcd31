# SPDX-License-Identifier: BSD-3-Clause
"""Rules of FMI 2.0.4 for a modelDescription.xml of co-simulation, in our own words (2.2 and 4.3 of the
standard): faults(root) lists what breaks them. It knows what rondo's FMUs have, and refuses the rest."""
import re

BOOL = re.compile("true|false|0|1")
UNSIGNED = re.compile("[0-9]+")
TEXT = re.compile(".*", re.DOTALL)
IDENTIFIER = re.compile("[A-Za-z_][A-Za-z0-9_]*")
REAL = re.compile(r"[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?")
INTEGER = re.compile("[-+]?[0-9]+")

# Element: its attributes (a trailing * : needed), its children in order (of each at most one; + : many).
FLAGS = {f: BOOL for f in (
    "canHandleVariableCommunicationStepSize", "canInterpolateInputs", "canRunAsynchronuously",
    "canBeInstantiatedOnlyOncePerProcess", "canNotUseMemoryManagementFunctions",
    "canGetAndSetFMUstate", "canSerializeFMUstate", "providesDirectionalDerivative",
    "needsExecutionTool")}
ELEMENTS = {
    "fmiModelDescription": (
        {"fmiVersion*": re.compile(r"2\.0"), "modelName*": TEXT, "guid*": TEXT, "description": TEXT,
         "author": TEXT, "version": TEXT, "copyright": TEXT, "license": TEXT, "generationTool": TEXT,
         "variableNamingConvention": re.compile("flat|structured"),
         "numberOfEventIndicators": UNSIGNED},
        ["CoSimulation", "UnitDefinitions", "LogCategories", "DefaultExperiment", "ModelVariables",
         "ModelStructure"]),
    "CoSimulation": ({"modelIdentifier*": IDENTIFIER, "maxOutputDerivativeOrder": UNSIGNED, **FLAGS}, []),
    "UnitDefinitions": ({}, ["Unit+"]),
    "Unit": ({"name*": TEXT}, ["BaseUnit"]),
    "BaseUnit": ({**{k: INTEGER for k in ("kg", "m", "s", "A", "K", "mol", "cd", "rad")},
                  "factor": REAL, "offset": REAL}, []),
    "LogCategories": ({}, ["Category+"]),
    "Category": ({"name*": TEXT, "description": TEXT}, []),
    "DefaultExperiment": ({k: REAL for k in ("startTime", "stopTime", "tolerance", "stepSize")}, []),
    "ModelVariables": ({}, ["ScalarVariable+"]),
    "ScalarVariable": (
        {"name*": TEXT, "valueReference*": UNSIGNED, "description": TEXT,
         "causality": re.compile("parameter|calculatedParameter|input|output|local|independent"),
         "variability": re.compile("constant|fixed|tunable|discrete|continuous"),
         "initial": re.compile("exact|approx|calculated")}, ["Real"]),
    "Real": ({"unit": TEXT, "start": REAL, "min": REAL, "max": REAL, "nominal": REAL}, []),
    "ModelStructure": ({}, ["Outputs", "InitialUnknowns"]),
    "Outputs": ({}, ["Unknown+"]),
    "InitialUnknowns": ({}, ["Unknown+"]),
    "Unknown": ({"index*": UNSIGNED}, []),
}

# What `initial` may be, its default first, for causality and variability (2.2.7).
KNOWN, FOUND, ANY = ("exact",), ("calculated", "approx"), ("calculated", "exact", "approx")
INITIAL = {("parameter", "fixed"): KNOWN, ("parameter", "tunable"): KNOWN,
           ("calculatedParameter", "fixed"): FOUND, ("calculatedParameter", "tunable"): FOUND,
           ("input", "discrete"): (None,), ("input", "continuous"): (None,),
           ("output", "constant"): KNOWN, ("output", "discrete"): ANY, ("output", "continuous"): ANY,
           ("local", "constant"): KNOWN, ("local", "fixed"): FOUND, ("local", "tunable"): FOUND,
           ("local", "discrete"): ANY, ("local", "continuous"): ANY,
           ("independent", "continuous"): (None,)}


def shape_faults(element):
    if element.tag not in ELEMENTS:
        yield f"there is no element {element.tag}"
        return
    attributes, children = ELEMENTS[element.tag]
    known = {name.rstrip("*"): pattern for name, pattern in attributes.items()}
    for name, value in element.attrib.items():
        if name not in known or not known[name].fullmatch(value):
            yield f"{element.tag}: {name}={value!r}"
    for name in attributes:
        if name.endswith("*") and name[:-1] not in element.attrib:
            yield f"{element.tag}: no {name[:-1]}"
    order = [name.rstrip("+") for name in children]
    tags = [child.tag for child in element]
    if any(tag not in order for tag in tags) or tags != sorted(tags, key=order.index):
        yield f"{element.tag}: {tags}"
        return
    for name in children:
        if not name.endswith("+") and tags.count(name) > 1:
            yield f"{element.tag}: several {name}"
        if name.endswith("+") and not tags:
            yield f"{element.tag}: empty"
    for child in element:
        yield from shape_faults(child)


def repeated(values):
    return sorted({value for value in values if values.count(value) > 1})


def initial_of(variable):
    kind = (variable.get("causality", "local"), variable.get("variability", "continuous"))
    allowed = INITIAL.get(kind, ())
    return variable.get("initial", allowed[0] if allowed else None), allowed


def variable_faults(variable, units):
    name, real = variable.get("name"), variable.find("Real")
    initial, allowed = initial_of(variable)
    if initial not in allowed:
        yield f"{name}: this initial, causality and variability do not go together"
    wants_start = initial in ("exact", "approx") or variable.get("causality") == "input"
    if wants_start != ("start" in real.attrib):
        yield f"{name}: a start value is {'missing' if wants_start else 'too much'}"
    if "unit" in real.attrib and real.get("unit") not in units:
        yield f"{name}: the unit {real.get('unit')} is not defined"
    if "min" in real.attrib and float(real.get("start", "inf")) < float(real.get("min")):
        yield f"{name}: it starts below its minimum"


def faults(root):
    found = list(shape_faults(root))
    if found:
        return found
    for needed in ("CoSimulation", "ModelVariables", "ModelStructure"):
        if root.find(needed) is None:
            return [f"no {needed}"]
    variables = list(root.find("ModelVariables"))
    if any(v.find("Real") is None for v in variables):
        return ["a variable has no type"]
    units = [unit.get("name") for unit in root.iter("Unit")]
    for what, values in (("variable", [v.get("name") for v in variables]), ("unit", units),
                         ("value reference", [v.get("valueReference") for v in variables]),
                         ("category", [c.get("name") for c in root.iter("Category")])):
        found += [f"the {what} {value} is there twice" for value in repeated(values)]
    for variable in variables:
        found += variable_faults(variable, units)
    outputs = [k + 1 for k, v in enumerate(variables) if v.get("causality") == "output"]
    unknowns = [k + 1 for k, v in enumerate(variables)
                if v.get("causality") == "calculatedParameter" or
                (v.get("causality") == "output" and initial_of(v)[0] != "exact")]
    for tag, wanted in (("Outputs", outputs), ("InitialUnknowns", unknowns)):
        told = [int(u.get("index")) for u in root.findall(f"ModelStructure/{tag}/Unknown")]
        if told != wanted:
            found.append(f"{tag} are {told}, and should be {wanted}")
    return found
