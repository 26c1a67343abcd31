// SPDX-License-Identifier: BSD-3-Clause
/// What rubber is refused with, each the one fault of an otherwise good case.
#include <gtest/gtest.h>

#include "unit/case/case_fixture.hpp"

namespace rondo::study::rubber_rules_test {
namespace {

using namespace test;

struct Refused {
  const char* name;
  std::string law;     ///< in the place of E: line 11
  std::string volume;  ///< in the place of ν: the line after it
  std::vector<std::string> settings;
  std::string key;
  std::vector<std::string> fragments;
};

std::ostream& operator<<(std::ostream& out, const Refused& refused) {
  return out << refused.name;
}

class RubberRules : public testing::TestWithParam<Refused> {};

TEST_P(RubberRules, Refuse) {
  const Refused& r = GetParam();
  const std::vector<Fault> faults = faults_of(rubber(r.law, r.volume), r.settings);
  std::string told;
  for (const Fault& fault : faults) told += fault.key + ": " + fault.message + "\n";
  ASSERT_EQ(faults.size(), 1U) << told;
  EXPECT_EQ(faults[0].key, r.key);
  if (r.settings.empty()) {
    EXPECT_GE(faults[0].line, 10);
    EXPECT_LE(faults[0].line, 16);
  }
  const std::string text = InputError(faults).what();
  for (const std::string& fragment : r.fragments)
    EXPECT_NE(text.find(fragment), std::string::npos) << fragment << " in " << text;
}

const std::string neo = "model = 'neo-hooke'\nshear_modulus = 1e6",
                  mooney = "model = 'mooney-rivlin'\nc10 = 4e5\n", yeoh = "model = 'yeoh'\n",
                  ogden = "model = 'ogden'\n", linear = "youngs_modulus = 2e7",
                  ratio = "poissons_ratio = 0.49", bulk = "bulk_modulus = 1e8";

INSTANTIATE_TEST_SUITE_P(
    Parameters, RubberRules,
    testing::Values(
        Refused{"UnknownModel",
                "model = 'neohooke'",
                ratio,
                {},
                "material.model",
                {"not one of the choices", "\"neo-hooke\""}},
        Refused{"YoungsModulus",
                neo + "\nyoungs_modulus = 3e6",
                ratio,
                {},
                "material.youngs_modulus",
                {"is a parameter of model = \"linear\"", "shear_modulus"}},
        Refused{"ShearModulusOfLinear",
                linear + "\nshear_modulus = 1e6",
                ratio,
                {},
                "material.shear_modulus",
                {"is a parameter of model = \"neo-hooke\"", "\"linear\""}},
        Refused{"BulkModulusOfLinear",
                linear,
                ratio + "\n" + bulk,
                {},
                "material.bulk_modulus",
                {"material.model is \"linear\""}},
        Refused{"CoefficientOfNeoHooke",
                neo + "\nc10 = 5e5",
                ratio,
                {},
                "material.c10",
                {"\"mooney-rivlin\", \"yeoh\"", "shear_modulus = 2 c10"}},
        Refused{"CoefficientOfYeoh",
                mooney + "c01 = 1e5\nc20 = 0",
                ratio,
                {},
                "material.c20",
                {"is a parameter of model = \"yeoh\""}},
        Refused{"TermsOfMooney",
                mooney + "c01 = 1e5\nterms = [[1, 1]]",
                ratio,
                {},
                "material.terms",
                {"is a parameter of model = \"ogden\"", "c10, c01"}},
        Refused{"ViscosityAsPairs",
                neo + "\nviscosity = [[0.3, 1]]",
                ratio,
                {},
                "material.viscosity",
                {"must be a list of tables", "[[material.viscosity]]"}},
        Refused{"BothOfVolume",
                neo,
                ratio + "\n" + bulk,
                {},
                "material.bulk_modulus",
                {"is given together with poissons_ratio"}},
        Refused{"NoneOfVolume", neo, "", {}, "material.poissons_ratio", {"is missing"}},
        Refused{"Incompressible",
                neo,
                "poissons_ratio = 0.5",
                {},
                "material.poissons_ratio",
                {"out of bounds", "< 0.5"}},
        Refused{"NegativeRatio",
                neo,
                "poissons_ratio = -0.1",
                {},
                "material.poissons_ratio",
                {"below 2/3", "below 0"}},
        Refused{"SmallBulkModulus",
                neo,
                "bulk_modulus = 6e5",
                {},
                "material.bulk_modulus",
                {"0.6 of the shear modulus", "bulk_modulus >= 2/3"}},
        Refused{"NoShearModulus",
                "model = 'neo-hooke'",
                ratio,
                {},
                "material.shear_modulus",
                {"is missing"}},
        Refused{"ZeroShearModulus",
                "model = 'neo-hooke'\nshear_modulus = 0",
                ratio,
                {},
                "material.shear_modulus",
                {"> 0"}},
        Refused{"MissingCoefficient", mooney, ratio, {}, "material.c01", {"is missing"}},
        Refused{"NegativeMooney",
                mooney + "c01 = -5e5",
                ratio,
                {},
                "material.c01",
                {"shear modulus of small strain -200000"}},
        Refused{"UnstableMooney",
                mooney + "c01 = -1e5",
                ratio,
                {},
                "material.c01",
                {"unstable", "equibiaxial", "stretch at 1.", "0.5 to 2"}},
        Refused{"UnstableYeoh",
                yeoh + "c10 = 5e5\nc20 = -5e4\nc30 = 0",
                ratio,
                {},
                "material.c20",
                {"unstable", "stretch at 1.41"}},
        Refused{"NoTerms", ogden + "terms = []", ratio, {}, "material.terms", {"at least one"}},
        Refused{"TermOfThree",
                ogden + "terms = [[1, 2, 3]]",
                ratio,
                {},
                "material.terms",
                {"must have 2 items"}},
        Refused{"ZeroExponent",
                ogden + "terms = [[1e6, 2], [1, 0]]",
                ratio,
                {},
                "material.terms",
                {"exponent 0", "[1, 0]"}},
        Refused{"NegativeOgden",
                ogden + "terms = [[1e6, -2]]",
                ratio,
                {},
                "material.terms",
                {"shear modulus"}},
        Refused{"Full",
                neo + "\nintegration = 'full'",
                ratio,
                {},
                "material.integration",
                {"locks", "\"b-bar\" or \"one-point\""}},
        Refused{"OnePointOfLinear",
                linear + "\nintegration = 'one-point'",
                ratio,
                {},
                "material.integration",
                {"is for rubber"}},
        Refused{"NoTime",
                neo,
                ratio,
                {"material.viscosity=[{relative_modulus = 0.3}]"},
                "material.viscosity[0].time",
                {"is missing"}},
        Refused{"ZeroTime",
                neo,
                ratio,
                {"material.viscosity=[{relative_modulus = 0.3, time = 0}]"},
                "material.viscosity[0].time",
                {"> 0"}},
        Refused{"NegativeBranch",
                neo,
                ratio,
                {"material.viscosity=[{relative_modulus = -0.3, time = 1}]"},
                "material.viscosity[0].relative_modulus",
                {"> 0"}}),
    [](const auto& p) { return p.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Regions, RubberRules,
    testing::Values(
        Refused{
            "LinearModulus",
            neo,
            ratio,
            {"material.region=[{layers = [1], youngs_modulus = 1e9}]"},
            "material.region[0].youngs_modulus",
            {"is a parameter of model = \"linear\"", "material.region[0].model is \"neo-hooke\""}},
        Refused{"OtherModelGivesItsVolume",
                neo,
                ratio,
                {"material.region=[{layers = [1], model = 'linear', youngs_modulus = 1e9}]"},
                "material.region[0].poissons_ratio",
                {"is missing"}},
        Refused{"OtherModelGivesItsModulus",
                linear,
                ratio,
                {"material.region=[{layers = [1], model = 'neo-hooke', bulk_modulus = 1e8}]"},
                "material.region[0].shear_modulus",
                {"is missing"}},
        Refused{"BothOfVolume",
                neo,
                ratio,
                {"material.region=[{layers = [1], poissons_ratio = 0.4, bulk_modulus = 1e8}]"},
                "material.region[0].bulk_modulus",
                {"is given together with poissons_ratio"}},
        Refused{"Full",
                neo,
                ratio,
                {"material.region=[{layers = [1], integration = 'full'}]"},
                "material.region[0].integration",
                {"locks"}},
        Refused{"Unstable",
                mooney + "c01 = 1e5",
                ratio,
                {"material.region=[{layers = [1], c01 = -1e5}]"},
                "material.region[0].c01",
                {"unstable"}},
        Refused{"NegativeTime",
                neo,
                ratio,
                {"material.region=[{layers = [1], viscosity = [[0.1, 1], [0.3, -1]]}]"},
                "material.region[0].viscosity",
                {"is no branch", "[0.3, -1]"}},
        Refused{"ViscosityAsTables",
                neo,
                ratio,
                {"material.region=[{layers = [1], viscosity = [{time = 1}]}]"},
                "material.region[0].viscosity",
                {"a pair of floats, not a table"}}),
    [](const auto& p) { return p.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Beside, RubberRules,
    testing::Values(
        Refused{"PlaneStress",
                neo,
                ratio,
                {"material.plane=stress"},
                "material.plane",
                {"plane strain"}},
        Refused{"Stiffening",
                neo,
                ratio,
                {"material.stress_stiffening=centrifugal"},
                "material.stress_stiffening",
                {"includes it"}},
        Refused{
            "AsPrinted", neo, ratio, {"time.scheme=as-printed"}, "time.scheme", {"\"symplectic\""}},
        Refused{"Hati",
                neo,
                ratio,
                {"time.scheme=hati", "solver.hati.ratio=2", "solver.hati.fine.layers=[11, 12]"},
                "time.scheme",
                {"\"symplectic\""}},
        Refused{"ContactMass",
                neo,
                ratio,
                {"solver.contact_mass=singular"},
                "solver.contact_mass",
                {"\"lumped\""}},
        Refused{"KeptContactMass",
                neo,
                ratio,
                {"solver.contact_mass=singular-kept"},
                "solver.contact_mass",
                {"\"lumped\""}},
        Refused{"Cyclic",
                neo,
                ratio,
                {"solver.operator=cyclic"},
                "solver.operator",
                {"finite strain", "\"sparse\""}},
        Refused{"Implicit",
                neo,
                ratio,
                {"solver.implicit=[{layers = [1]}]"},
                "solver.implicit[0]",
                {"linear elements only", "no [[solver.implicit]]"}},
        Refused{"ImplicitBesideARegion",
                linear,
                ratio,
                {"solver.implicit=[{slower_than = 1e-6}, {layers = [1]}]",
                 "material.region=[{layers = [12], model = 'neo-hooke', shear_modulus = 1e6, "
                 "bulk_modulus = 1e8}]"},
                "solver.implicit[0]",
                {"linear elements only"}},
        Refused{"SteadyRolling",
                neo,
                ratio,
                {"analysis.kind=steady-rolling", "ground.profile=flat"},
                "analysis.kind",
                {"small strain"}},
        Refused{"SteadyStart",
                neo,
                ratio,
                {"initial.state=steady-rolling", "ground.profile=flat"},
                "initial.state",
                {"\"rest\""}},
        Refused{"InARegion",
                linear,
                ratio,
                {"material.plane=stress",
                 "material.region=[{layers = [12], model = 'neo-hooke', shear_modulus = 1e6, "
                 "bulk_modulus = 1e8}]"},
                "material.plane",
                {"plane strain"}}),
    [](const auto& p) { return p.param.name; });

/// ν of a material by its sign and bounds: 0 and what is just below ½ are taken.
TEST(RubberRange, TakeTheEndsOfTheRange) {
  EXPECT_TRUE(faults_of(rubber(neo, "poissons_ratio = 0.0")).empty());
  EXPECT_TRUE(faults_of(rubber(neo, "poissons_ratio = 0.49999")).empty());
  EXPECT_TRUE(faults_of(rubber(neo, "bulk_modulus = 1e13")).empty());
  EXPECT_EQ(faults_of(rubber(neo, "bulk_modulus = 1.01e13")).size(), 1U);
  EXPECT_EQ(faults_of(rubber(neo, "poissons_ratio = 0.49999999")).size(), 1U);
}

}  // namespace
}  // namespace rondo::study::rubber_rules_test
