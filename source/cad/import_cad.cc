#include <snug/base/errors.h>
#include <snug/base/gather.h>
#include <snug/cad/faces.h>
#include <snug/cad/gmsh.h>
#include <snug/cad/import_cad.h>
#include <snug/cad/size_field.h>
#include <snug/mesh_file/import_mesh.h>

#include <Standard_Failure.hxx>

#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

namespace snug::cad {
namespace {
/// This struct stores the part and its mesh.
struct MeshedPart
{
  std::string                         brep, mesh;
  std::vector<std::string>            boundaries; ///< of the faces
  std::vector<std::string>            table;      ///< of the faces, see table_of()
  std::map<std::string, unsigned int> of_group;   ///< group of the mesh -> face
};

/// Run a step of the import. Its time is printed if it takes more than a second.
template <typename Work>
auto timed(RunContext &context, const std::string &file, const std::string &step, const Work &work)
{
  const std::string text = std::filesystem::path(file).filename().string() + ", " + step;
  context.progress(text + " ...");
  const double start   = context.seconds();
  const auto   result  = work();
  const double seconds = context.seconds() - start;
  if (seconds > 1.)
    context.out() << text << ": " << to_text(std::round(10. * seconds) / 10.) << " s" << std::endl;
  return result;
}

/// Run @p work with errors of OpenCASCADE, which are no std::exception, as errors of the file.
template <typename Work>
auto guarded(const geometry::BodyMeshParameters &parameters, const Work &work)
{
  try
    {
      return work();
    }
  catch (const Standard_Failure &failure)
    {
      throw bad_entry("File", parameters.file,
                      std::string("OpenCASCADE fails: ") + failure.GetMessageString());
    }
}

std::string contents(const std::string &path)
{
  std::ifstream      in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Check the entries that need the size of the part.
void check_sizes(const geometry::BodyMeshParameters &parameters,
                 const std::vector<std::string>     &boundaries,
                 const double                        size)
{
  if (!(parameters.element_size > 0.))
    throw bad_entry("Element size", to_text(parameters.element_size),
                    "must be positive; the diagonal of the part is " +
                      to_text(std::round(size * 1e3) / 1e3));
  const std::set<std::string> all(boundaries.begin(), boundaries.end());
  for (const auto &[boundary, own] : parameters.face_sizes)
    {
      const std::string given = boundary + ": " + to_text(own);
      if (all.count(boundary) == 0)
        throw bad_entry("Face sizes", given,
                        "is not a boundary; the boundaries are " +
                          to_text(std::vector<std::string>(all.begin(), all.end())));
      if (!(own > 0. && own <= parameters.element_size))
        throw bad_entry("Face sizes", given, "must be positive and at most 'Element size'");
    }
}

/// Return the error of sizes that give more than a million elements, with the entries that the user
/// wrote.
InputError too_many_elements(const geometry::BodyMeshParameters &parameters)
{
  const bool halved = !parameters.halved.empty(), faces = !parameters.face_sizes.empty();
  const auto n_mesh = std::to_string(parameters.halved.size() + 1);
  return bad_entry("Element size", to_text(parameters.element_size),
                   std::string("gives more than a million elements") +
                     (faces ? " with 'Face sizes'" : "") +
                     (halved ? " in mesh " + n_mesh + " for 'Target'" : "") + "; increase " +
                     (faces ? "the sizes" : "the size") +
                     (halved ? " or reduce 'Maximum levels'" : ""));
}

/// Return the mesh with the names of the boundaries as names of its groups.
std::string named(const std::string                         &mesh,
                  const std::map<std::string, unsigned int> &of_group,
                  const std::vector<std::string>            &boundaries,
                  const unsigned int                         dim)
{
  std::ostringstream names;
  names << "$PhysicalNames\n" << of_group.size() + 1 << '\n';
  for (const auto &[group, face] : of_group)
    names << dim - 1 << ' ' << group.substr(mesh_file::unnamed_group.size()) << " \""
          << boundaries[face] << "\"\n";
  names << dim << " 1 \"body\"\n$EndPhysicalNames\n";
  const std::string end   = "$EndMeshFormat\n";
  const auto        place = mesh.find(end) + end.size();
  return mesh.substr(0, place) + names.str() + mesh.substr(place);
}

/// Mesh the part on this rank. @p stem is the path of the files of Gmsh without their endings.
MeshedPart meshed(const geometry::BodyMeshParameters &parameters,
                  const unsigned int                  dim,
                  const std::string                  &stem,
                  RunContext                         &context)
{
  const auto run = [&](const std::string &step, const auto &work) {
    return timed(context, parameters.file, step, work);
  };
  const Part part =
    run("reading", [&]() { return read_part(parameters.file, parameters.solid, dim); });
  const auto faces = run("list of faces", [&]() { return describe_faces(part); });
  MeshedPart result;
  result.boundaries = boundaries_of(faces, parameters.cad_faces);
  result.table      = table_of(faces, result.boundaries, dim);
  result.brep       = to_brep(part.shape);
  check_sizes(parameters, result.boundaries, part.size);
  const auto      field = run("element sizes", [&]() {
    ElementSizes sizes{size_sources(part, result.boundaries, parameters.face_sizes,
                                         parameters.element_size),
                       parameters.element_size, parameters.size_growth};
    for (const auto &places : parameters.halved)
      sizes.halve(places);
    return SizeField(part, std::move(sizes), too_many_elements(parameters)).text();
  });
  std::error_code unused; // writing fails if there is no directory
  std::filesystem::create_directories(std::filesystem::path(stem).parent_path(), unused);
  try
    {
      result.mesh     = run("mesh by gmsh", [&]() {
        run_gmsh(stem, result.brep, field, dim);
        return contents(stem + ".msh");
      });
      result.of_group = run("faces of the mesh", [&]() {
        return faces_of_groups(part, mesh_file::read_mesh_file(result.mesh));
      });
    }
  catch (const InputError &error)
    {
      throw bad_entry("File", parameters.file, error.what());
    }
  std::ofstream(stem + ".msh", std::ios::binary)
    << named(result.mesh, result.of_group, result.boundaries, dim);
  return result;
}

/// Return the faces of a shape. Shapes of the same text agree to the last digit.
template <int dim>
mesh_file::ExactFaces<dim> exact_faces_of(const std::string &brep)
{
  Part part;
  part.shape = from_brep(brep);
  part.dim   = dim;
  return exact_faces<dim>(part);
}

/// Return the blocks of the mesh, with the true surfaces of the faces.
template <int dim>
std::shared_ptr<geometry::ImportedMesh> blocks_of(const MeshedPart            &meshed,
                                                  geometry::BodyMeshParameters parameters)
{
  auto file = mesh_file::read_mesh_file(meshed.mesh);
  for (auto &element : file.elements)
    if (mesh_file::dimension(element.shape) == dim)
      element.groups.clear(); // the only region
  parameters.boundary_numbers.clear();
  for (const auto &[group, face] : meshed.of_group)
    parameters.boundary_numbers[group] = meshed.boundaries[face];
  auto exact          = exact_faces_of<dim>(meshed.brep);
  exact.face_of_group = meshed.of_group;
  auto result         = mesh_file::import_mesh<dim>(file, parameters, &exact);
  result->text_hash   = mesh_file::text_hash(meshed.mesh);
  result->faces       = meshed.table;
  result->brep        = meshed.brep;
  result->boundaries  = meshed.boundaries;
  return result;
}

/// Return the mesh of the part on rank 0, and without cells on all other ranks. Collective.
template <int dim>
std::shared_ptr<const geometry::ImportedMesh>
import_in(const geometry::BodyMeshParameters &parameters,
          const std::string                  &stem,
          RunContext                         &context)
{
  std::shared_ptr<const geometry::ImportedMesh> whole;
  const geometry::ImportedMesh empty = made_on_first_rank(context.communicator(), [&]() {
    return guarded(parameters, [&]() {
      const auto part = meshed(parameters, dim, stem, context);
      whole           = timed(context, parameters.file, "curved cells",
                              [&]() { return blocks_of<dim>(part, parameters); });
      return *whole->without_cells();
    });
  });
  auto                         mesh  = *empty.blocks<dim>();
  throw_collectively(context.communicator(), [&]() {
    if (!whole)
      guarded(parameters,
              [&]() { mesh.projections = exact_faces_of<dim>(empty.brep).projections; });
  });
  if (whole)
    return whole;
  auto result           = std::make_shared<geometry::ImportedMesh>(empty);
  result->blocks<dim>() = std::make_shared<const geometry::BlockMesh<dim>>(std::move(mesh));
  return result;
}
} // namespace

bool is_cad_file(const std::string &path)
{
  const std::set<std::string> endings = {".step", ".stp", ".iges", ".igs", ".brep", ".brp"};
  return endings.count(ending_of(path)) > 0;
}

std::shared_ptr<const geometry::ImportedMesh>
import_cad(const geometry::BodyMeshParameters &parameters,
           const unsigned int                  dim,
           const std::string                  &stem,
           RunContext                         &context)
{
  return dim == 2 ? import_in<2>(parameters, stem, context)
                  : import_in<3>(parameters, stem, context);
}
} // namespace snug::cad
