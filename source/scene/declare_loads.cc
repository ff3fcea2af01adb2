#include <snug/scene/entries.h>

namespace snug::scene {
void add_gravity(Entries &entries, std::vector<double> &gravity)
{
  entries.add("Gravity",
              {[&gravity]() { return to_text(gravity); },
               [&gravity](const std::string &text) {
                 std::vector<double> result;
                 for (const auto &component : vector_components(text))
                   from_text(component, result.emplace_back());
                 gravity = result;
               }},
              anything("numbers separated by commas or blanks"),
              "Acceleration along x, y, z [length/time^2]; times 'Density' "
              "it is a body force: '0 0 -9.81'. Empty: none.");
}

void declare_loads(Entries &entries, LoadParameters &loads, const std::string &key)
{
  const std::string list  = "a list '" + key + ": ";
  const std::string where = key == "boundary" ? "top" : "punch.top";
  entries.add("Displacement",
              {[&loads]() { return to_text(loads.displacements); },
               [&loads](const std::string &text) { from_text(text, loads.displacements); }},
              pairs(list + "component = formula, ...'"),
              "Prescribed displacement components [length]: x, y, z or normal, by "
              "formulas of x, y, z in the reference geometry: '" +
                where + ": z = -0.012, " + where +
                ": x = 1e-3*y'. The other components stay free.");
  entries.add("Pressure", loads.pressure, pairs(list + "formula, ...' of different boundaries"),
              "Pressure [force/length^2], a number or a formula of x, y, z "
              "in the reference geometry; positive pushes: '" +
                where + ": 100*(1-x^2)'.");
  entries.add("Traction", loads.traction,
              pairs(list + "formula formula formula, ...' of different "
                           "boundaries, one formula per dimension, "
                           "separated by blanks"),
              "Force per area [force/length^2], numbers or formulas of x, "
              "y, z in the reference geometry, separated by blanks: '" +
                where + ": 0 0 -5*x'.");
  entries.add("Force", loads.force,
              pairs(list + "x y z, ...' of different boundaries, components "
                           "separated by blanks"),
              "Total force [force], spread evenly over the area of the "
              "boundary as the design makes it: '" +
                where + ": 0 0 -1000'.");
  entries.add("Moment", loads.moment,
              pairs(list + "x y z, ...' of different boundaries, components "
                           "separated by blanks"),
              "Moment about the centroid of the boundary [force length], "
              "spread linearly over it; one number in 2D: '" +
                where + ": 0 50 0'.");
}

void declare_load_cases(Entries &entries, Scene &scene)
{
  for (auto &load_case : scene.load_cases)
    {
      entries.begin_section("Load case " + load_case.name,
                            "Loads of one load case besides those of the "
                            "bodies and the scene. A displacement component "
                            "prescribed in one load case is held in all: at "
                            "zero where they say nothing.");
      entries.add("Weight", load_case.weight,
                  "Factor of its objective in the sum over load cases, or "
                  "in their worst.");
      add_gravity(entries, load_case.gravity);
      declare_loads(entries, load_case.loads, "body.boundary");
    }
}
} // namespace snug::scene
