#include <snug/app/designed_face.h>
#include <snug/app/results.h>
#include <snug/cad/moved_solid.h>
#include <snug/geometry/entry_values.h>
#include <snug/geometry/imported_mesh.h>
#include <snug/geometry/placement.h>

#include <sstream>

namespace snug::app {
namespace {
/// Points of the true surface within the edges of a face are closer to the mesh than this part of
/// the size of an element.
const double on_face = 1e-4;

/// Return the surface of a design over the parameters of a face of a solid.
io::SplineSurface<3> fitted(const cad::MovedSolid         &solid,
                            const unsigned int             f,
                            const cad::MovedSolid::Domain &domain,
                            const DesignedFace<3>         &face,
                            const double                   asked)
{
  const shape::FacePlaces<3> places(face.shaped_face(), face.shaped_face().positions());
  io::CoordinatePoints<3>    points;
  points.range  = domain.upper - domain.lower;
  points.closed = domain.closed;
  points.point  = [&](const dealii::Tensor<1, 2> &at) -> std::optional<dealii::Tensor<1, 3>> {
    const dealii::Tensor<1, 3> x     = solid.point(f, domain.lower + at);
    const auto                 place = places.closest(x, on_face);
    if (!place)
      return {};
    return x + place->value(face.positions()) - place->value(face.shaped_face().positions());
  };
  return io::fit_splines(points, asked, most_points);
}
} // namespace

template <>
void Results<2>::export_solids(const std::vector<DesignedFace<2>> & /*designed*/)
{}

template <>
void Results<3>::export_solids(const std::vector<DesignedFace<3>> &designed)
{
  const auto              &scene = problem->scene;
  std::vector<std::string> failures;
  for (const auto &body : scene.bodies)
    {
      const auto       &imported = body.mesh.imported;
      const std::string file     = io::solid_file(scene, body);
      if (file.empty())
        continue;
      try
        {
          const cad::MovedSolid                   solid(imported->brep, body.mesh.scale,
                                                        geometry::rotation_of<3>(body.mesh),
                                                        geometry::per_axis<3, double>("Shift", body.mesh.shift, 0.,
                                                                                      false));
          std::map<unsigned int, cad::SplineFace> moved;
          std::vector<std::string>                names;
          double                                  deviation = 0., tolerance = 0.;
          for (unsigned int f = 0; f < imported->boundaries.size(); ++f)
            {
              names.push_back(body.name + '.' + imported->boundaries[f]);
              for (const auto &face : designed)
                if (face.name == names.back())
                  {
                    const double asked   = scene.output.profile_deviation * face.size();
                    const auto   domain  = solid.domain(f);
                    const auto   surface = fitted(solid, f, domain, face, asked);
                    moved[f]  = spline_face<3>(surface, domain.upper - domain.lower, domain.lower);
                    deviation = std::max(deviation, surface.deviation);
                    tolerance = std::max({tolerance, asked, surface.deviation});
                  }
            }
          if (moved.empty())
            continue;
          if (!body.mesh.warp.empty())
            throw InputError("it has a 'Warp'");
          const double volume = solid.write(file, Units(scene.units).name("length"), body.name,
                                            names, moved, tolerance);
          std::ostringstream line;
          line << body.name << ".step: solid of " << names.size() << " faces, " << moved.size()
               << " of them moved, volume " << volume << Units(scene.units).after_number("length^3")
               << ", maximum deviation from the design " << deviation
               << Units(scene.units).after_number("length");
          problem->context.out() << line.str() << std::endl;
        }
      catch (const InputError &error)
        {
          failures.push_back(body.name + ".step is not written: " + error.what());
        }
    }
  problem->context.warn("export", failures);
}
} // namespace snug::app
