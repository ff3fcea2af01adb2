#include <snug/response/pressure_measures.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <string>

namespace {
using namespace snug::response;

using Measure = std::function<Measured(const PressureRows &)>;

const std::map<std::string, Measure> measures = {
  {"area", [](const auto &rows) { return contact_area(rows, 0.1); }},
  {"wide area", [](const auto &rows) { return contact_area(rows, 1.); }},
  {"norm 1", [](const auto &rows) { return pressure_norm(rows, 1.); }},
  {"norm 8", [](const auto &rows) { return pressure_norm(rows, 8.); }},
  {"peak 1", [](const auto &rows) { return peak_pressure(rows, 1.); }},
  {"peak 8", [](const auto &rows) { return peak_pressure(rows, 8.); }},
  {"peak 100", [](const auto &rows) { return peak_pressure(rows, 100.); }},
  {"variance", pressure_variance}};

/// A third of the rows is open.
PressureRows random_rows(unsigned int n)
{
  std::mt19937                           generator(5);
  std::uniform_real_distribution<double> uniform(0.2, 1.);
  PressureRows                           rows;
  for (unsigned int i = 0; i < n; ++i)
    {
      rows.area.push_back(0.01 * uniform(generator));
      rows.force.push_back(i % 3 == 0 ? 0. : 2. * uniform(generator));
    }
  return rows;
}

double largest_pressure(const PressureRows &rows)
{
  double largest = 0.;
  for (unsigned int i = 0; i < rows.force.size(); ++i)
    largest = std::max(largest, rows.force[i] / rows.area[i]);
  return largest;
}

TEST(PressureMeasures, DerivativesAreThoseOfTheValue)
{
  const auto rows = random_rows(12);
  for (const auto &[name, measure] : measures)
    {
      const auto at     = measure(rows);
      double     size_p = 0., size_A = 0.;
      for (unsigned int i = 0; i < 12; ++i)
        {
          size_p = std::max(size_p, std::abs(at.by_force[i]));
          size_A = std::max(size_A, std::abs(at.by_area[i]));
        }
      for (unsigned int i = 0; i < 12; ++i)
        for (const bool of_force : {true, false})
          {
            double slope = 0.;
            for (const double place : {-2., -1., 1., 2.})
              {
                auto   moved = rows;
                auto  &x     = of_force ? moved.force[i] : moved.area[i];
                double step  = 1e-4 * x;
                if (step == 0.) // where contact opens: nothing to compare
                  continue;
                x += place * step;
                const double weight = (std::abs(place) == 1. ? 8. : -1.) * (place > 0 ? 1 : -1);
                slope += weight / (12. * step) * measure(moved).value;
              }
            if (of_force && rows.force[i] == 0.)
              continue;
            EXPECT_NEAR(of_force ? at.by_force[i] : at.by_area[i], slope,
                        1e-8 * (of_force ? size_p : size_A) +
                          1e-9 * at.value / (of_force ? rows.force[i] : rows.area[i]))
              << name << ", row " << i;
          }
    }
}

TEST(PressureMeasures, AnEvenPressureIsMeasuredExactly)
{
  auto   rows = random_rows(9);
  double area = 0.;
  for (unsigned int i = 0; i < 9; ++i)
    {
      rows.force[i] = 7. * rows.area[i];
      area += rows.area[i];
    }
  EXPECT_NEAR(contact_area(rows, 0.3).value, area, 1e-14 * area);
  EXPECT_NEAR(pressure_norm(rows, 3.).value, 7. * std::cbrt(area), 1e-14);
  EXPECT_NEAR(peak_pressure(rows, 5.).value, 7., 1e-13);
  EXPECT_NEAR(pressure_variance(rows).value, 0., 1e-26);
}

TEST(PressureMeasures, ThePeakIsApproachedFromBelow)
{
  const auto   rows    = random_rows(30);
  const double largest = largest_pressure(rows);
  double       before  = 0.;
  for (const double p : {1., 2., 8., 32., 128., 1000.})
    {
      const double peak = peak_pressure(rows, p).value;
      EXPECT_GT(peak, before);
      EXPECT_LT(peak, largest);
      before = peak;
    }
  EXPECT_NEAR(before, largest, 0.01 * largest);
}

TEST(PressureMeasures, DividingRowsChangesNothing)
{
  const auto   rows = random_rows(10);
  PressureRows divided;
  for (unsigned int i = 0; i < 10; ++i)
    for (const double part : {0.3, 0.7})
      {
        divided.force.push_back(part * rows.force[i]);
        divided.area.push_back(part * rows.area[i]);
      }
  for (const auto &[name, measure] : measures)
    EXPECT_NEAR(measure(divided).value, measure(rows).value, 1e-12 * measure(rows).value) << name;
}

TEST(PressureMeasures, WithoutPressureAreZero)
{
  auto rows = random_rows(4);
  rows.force.assign(4, 0.);
  for (const auto &[name, measure] : measures)
    {
      const auto at = measure(rows);
      EXPECT_EQ(at.value, 0.) << name;
      EXPECT_EQ(at.by_force, std::vector<double>(4, 0.)) << name;
      EXPECT_EQ(at.by_area, std::vector<double>(4, 0.)) << name;
    }
}
} // namespace
