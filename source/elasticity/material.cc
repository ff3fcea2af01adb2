#include <snug/base/section_check.h>
#include <snug/elasticity/material.h>

namespace snug::elasticity {
void Material::declare(Entries &entries)
{
  entries.add("Young's modulus", youngs_modulus, positive(),
              "The Young's modulus, positive. Units: force/length^2.");
  entries.add("Poisson's ratio", poissons_ratio, inside(-1., 0.5),
              "The Poisson's ratio, above -1 and below 0.5.");
  entries.add("Yield stress", yield_stress, at_least(0.),
              "The yield stress in tension, with which the von Mises stresses are compared; the "
              "material stays elastic. A value of 0 means no comparison. Units: force/length^2.");
  entries.add("Density", density, at_least(0.),
              "The mass per volume, for gravity and the quantity mass. Units: mass/length^3.");
  entries.add("Expansion", expansion,
              "The coefficient of thermal expansion, the strain per 'Temperature'. Units: "
              "1/temperature.");
}

void Material::check(const SectionCheck &section) const
{
  // Displacements are proportional to the inverse of the modulus, and terms of the dual problem
  // to their squares.
  section.require(youngs_modulus >= 1e-60, "Young's modulus", to_text(youngs_modulus),
                  "must be at least 1e-60, or forces and displacements overflow");
}
} // namespace snug::elasticity
