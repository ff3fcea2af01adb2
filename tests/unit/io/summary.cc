#include <snug/io/summary.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <sstream>

#include "scratch.h"

namespace snug {
namespace {
using Json = nlohmann::ordered_json;

/// The keys other tools read.
const std::map<std::string, std::string> fixed_keys = {
  {"program", "version dealii petsc blas compiler ranks"},
  {"mesh", "bodies cells dofs subdomains ranks constraints contact_rows "
           "rigid_body_modes"},
  {"state", "least_scaled_jacobian energy compliance strain_energy contact_force "
            "contact_area "
            "max_pressure active_contacts outer_iterations f_mults linear_f_mults "
            "certificate"},
  {"gradient", "method f_mults values"},
  {"optimization", "algorithm iterations evaluations objective_initial objective_final "
                   "constraint_violation projected_gradient stop_reason design"},
  {"work", "f_mults preconditioner_applications coarse_solves "
           "symbolic_factorizations numeric_factorizations assembled_subdomains "
           "soft_modes"},
  {"times", "setup assembly factorization soft_modes solve gradient output total"}};

void expect_fixed_keys(const Json &json)
{
  for (const auto &part : fixed_keys)
    {
      ASSERT_TRUE(json.contains(part.first)) << part.first;
      std::istringstream keys(part.second);
      for (std::string key; keys >> key;)
        EXPECT_TRUE(json[part.first].contains(key)) << part.first << ": " << key;
    }
  for (const char *key :
       {"equilibrium", "continuity", "penetration", "negative_pressure", "complementarity"})
    EXPECT_TRUE(json["state"]["certificate"].contains(key)) << key;
}

TEST(Summary, HasTheFixedKeysWhateverTheTask)
{
  io::Summary summary;
  summary.state = io::summarize(state::ContactState<3>());
  expect_fixed_keys(Json::parse(summary.json()));
  summary.gradient.emplace();
  summary.optimization.emplace();
  summary.initial_state.emplace();
  expect_fixed_keys(Json::parse(summary.json()));
}

TEST(Summary, HasTheBalanceOfSeveralRanksOnly)
{
  io::Summary summary;
  EXPECT_FALSE(Json::parse(summary.json()).contains("balance"));
  summary.balance.emplace();
  summary.balance->unknowns = {1., 2., 4.};
  summary.balance->seconds  = {{"solve", {0.5, 0.5, 0.5}}};
  summary.balance->bytes    = 80;
  const Json json           = Json::parse(summary.json())["balance"];
  EXPECT_EQ(json["unknowns"], Json::parse(R"({"least": 1.0, "mean": 2.0, "largest": 4.0})"));
  EXPECT_EQ(json["seconds"]["solve"]["mean"], 0.5);
  EXPECT_EQ(json["f_mult"]["bytes"], 80);
}

TEST(Balance, TellsWhatToDoIfItIsBad)
{
  io::Balance balance;
  EXPECT_EQ(io::balance_note(balance), "");
  balance.n_ranks      = 8;
  balance.n_subdomains = 10;
  balance.subdomains   = {1., 1.25, 2.};
  balance.unknowns     = {650., 812.5, 1300.};
  EXPECT_EQ(io::balance_note(balance),
            "balance: a rank has 1.6 times the mean number of unknowns: use 5 ranks, which is as "
            "fast, or set Decomposition/Subdomains to 32 or more");
  balance.unknowns.largest = 1000.;
  EXPECT_EQ(io::balance_note(balance), "");
  balance.own_seconds = {0.4, 0.5, 0.9}; // may be noise
  EXPECT_EQ(io::balance_note(balance), "");
  balance.own_seconds = {4., 5., 9.};
  EXPECT_NE(io::balance_note(balance).find("core of its own"), std::string::npos);
}

TEST(Summary, NumbersReadBackBitForBit)
{
  io::Summary            summary;
  state::ContactState<3> state;
  state.energy           = -0.1 - 0.2;
  state.contact_force[0] = 1. / 3.;
  state.contact_force[1] = 4.9406564584124654e-324;
  state.contact_force[2] = -0.;
  summary.state          = io::summarize(state);
  summary.optimization.emplace();
  summary.optimization->x = {std::nextafter(1., 2.), 1e300};
  summary.work.f_mults    = 1ul << 60;
  const Json json         = Json::parse(summary.json());
  EXPECT_EQ(json["state"]["energy"].get<double>(), -0.1 - 0.2);
  for (unsigned int d = 0; d < 3; ++d)
    EXPECT_EQ(json["state"]["contact_force"][d].get<double>(), state.contact_force[d]);
  EXPECT_EQ(json["optimization"]["design"].get<std::vector<double>>(), summary.optimization->x);
  EXPECT_EQ(json["work"]["f_mults"].get<unsigned long>(), 1ul << 60);
}

TEST(Summary, WhatIsNotComputedIsNull)
{
  io::Summary            summary;
  state::ContactState<2> state;
  state.energy    = std::numeric_limits<double>::infinity();
  summary.state   = io::summarize(state);
  const Json json = Json::parse(summary.json());
  EXPECT_TRUE(json["state"]["energy"].is_null());
  EXPECT_TRUE(json["state"]["accuracy"].is_null());
  EXPECT_TRUE(json["state"]["linear_f_mults"].is_null());
  EXPECT_TRUE(json["optimization"]["iterations"].is_null());
  EXPECT_TRUE(json["gradient"]["values"].is_null());
}

TEST(Summary, TheStateNamesItsLoadCaseAndTheLargestOfAll)
{
  io::Summary summary;
  Json        json = Json::parse(summary.json());
  for (const char *key : {"load_case", "load_cases", "largest"})
    EXPECT_TRUE(json["state"].contains(key) && json["state"][key].is_null()) << key;
  summary.load_cases.resize(3);
  const char *names[] = {"push", "pull", "twist"};
  for (unsigned int c = 0; c < 3; ++c)
    {
      state::ContactState<2> state;
      state.max_pressure           = c == 1 ? 30. : 10. - c;
      state.contact_area           = 1.;
      state.compliance             = -5. + c;
      state.certificate.continuity = 1e-9 * (c + 1);
      summary.load_cases[c].name   = names[c];
      summary.load_cases[c].state  = io::summarize(state, {{"tip", c == 0 ? 0.3 : -0.3}});
    }
  summary.state = summary.load_cases[0].state;
  json          = Json::parse(summary.json())["state"];
  EXPECT_EQ(json["load_case"], "push");
  EXPECT_EQ(json["max_pressure"], 10.);
  EXPECT_EQ(json["load_cases"].size(), 3u);
  EXPECT_EQ(json["load_cases"]["twist"]["max_pressure"], 8.);
  EXPECT_EQ(json["load_cases"]["twist"]["responses"]["tip"], -0.3);
  const auto largest = [&](const char *name) { return json["largest"][name]; };
  EXPECT_EQ(largest("max_pressure"), Json::parse(R"({"load_case": "pull", "value": 30.0})"));
  EXPECT_EQ(largest("compliance"), Json::parse(R"({"load_case": "twist", "value": -3.0})"));
  EXPECT_EQ(largest("worst_certificate")["load_case"], "twist");
  EXPECT_EQ(largest("responses")["tip"]["load_case"], "push");
}

TEST(Summary, WarningsMayHoldAnything)
{
  io::Summary summary;
  summary.warnings = {{"strain", "a \"quoted\" \\ line\n", 0.2, 0.1}, {"deck", "not UTF-8: \xff"}};
  const Json json  = Json::parse(summary.json());
  EXPECT_EQ(json["warnings"][0].get<std::string>(), summary.warnings[0].text);
  EXPECT_EQ(json["checks"][0]["code"], "strain");
  EXPECT_EQ(json["checks"][0]["bound"], 0.1);
  EXPECT_TRUE(json["checks"][1]["value"].is_null());
}

TEST(Summary, IsWrittenAsItIs)
{
  const test::ScratchDirectory scratch;
  io::Summary                  summary;
  summary.task = "state";
  if (!scratch.is_first())
    return;
  summary.write(scratch.file("summary.json"));
  EXPECT_EQ(test::read_file(scratch.file("summary.json")), summary.json());
}

TEST(Summary, CopiesAState)
{
  state::ContactState<3> state;
  state.energy                  = 1.5;
  state.contact_force[2]        = -7.;
  state.active_contacts         = 11;
  state.dual.outer_iterations   = 4;
  state.dual.method             = "active set";
  state.linear_f_mults          = 19;
  state.certificate.penetration = 1e-9;
  state.tolerance               = 2e-3;
  io::Summary summary;
  summary.state   = io::summarize(state);
  const Json json = Json::parse(summary.json())["state"];
  EXPECT_EQ(json["energy"], 1.5);
  EXPECT_EQ(json["contact_force"], Json::parse("[0.0, 0.0, -7.0]"));
  EXPECT_EQ(json["active_contacts"], 11);
  EXPECT_EQ(json["outer_iterations"], 4);
  EXPECT_EQ(json["method"], "active set");
  EXPECT_EQ(json["linear_f_mults"], 19);
  EXPECT_EQ(json["tolerance"], 2e-3);
  EXPECT_EQ(json["certificate"]["penetration"], 1e-9);
}

TEST(Summary, TimesAreThoseOfTheSlowestRank)
{
  std::ostringstream log;
  RunContext         context(MPI_COMM_WORLD, log);
  if (context.rank() + 1 == context.n_ranks())
    {
      const RunContext::Timer timer(context, "solve");
      while (context.seconds() < 0.02)
        continue;
    }
  const auto times = io::collect_times(context);
  EXPECT_GT(times.solve, 0.);
  EXPECT_GE(times.total, times.solve);
  EXPECT_EQ(times.gradient, 0.);
}

TEST(ProgramInfo, TellsVersionsAndBlas)
{
  std::ostringstream log;
  const RunContext   context(MPI_COMM_WORLD, log);
  const auto         program = io::program_info(context);
  EXPECT_EQ(program.ranks, context.n_ranks());
  for (const auto &text : {program.version, program.dealii, program.petsc, program.compiler})
    EXPECT_FALSE(text.empty());
  EXPECT_NE(program.blas, "unknown");
}

TEST(ProgramInfo, KnowsTheReferenceBlasFromOthers)
{
  const std::string lib = "/usr/lib/x86_64-linux-gnu/";
  EXPECT_EQ(io::blas_name(lib + "blas/libblas.so.3.11.0", ""), "reference");
  // OpenBLAS loaded by another library does not make dgemm fast
  EXPECT_EQ(io::blas_name(lib + "blas/libblas.so.3.11.0", "OpenBLAS 0.3"), "reference");
  EXPECT_EQ(io::blas_name(lib + "openblas-serial/libblas.so.3", "OpenBLAS 0.3.21"),
            "OpenBLAS 0.3.21");
  EXPECT_EQ(io::blas_name(lib + "libopenblas.so.0", ""), "OpenBLAS");
  EXPECT_EQ(io::blas_name("/opt/intel/libmkl_rt.so.2", ""), "mkl");
  EXPECT_EQ(io::blas_name("", ""), "unknown");

  io::Summary::Program program;
  program.blas = "reference";
  EXPECT_NE(io::blas_warning(program).find("openblas"), std::string::npos);
  EXPECT_EQ(io::blas_warning(program).find('\n'), std::string::npos);
  program.blas = "mkl";
  EXPECT_EQ(io::blas_warning(program), "");
}
} // namespace
} // namespace snug
