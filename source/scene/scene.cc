#include <snug/scene/scene.h>

namespace snug
{
  namespace scene
  {
    namespace
    {
      template <int dim>
      std::vector<std::string>
      boundary_names_in(const mesh::BodyMeshParameters &parameters)
      {
        return choose(mesh::body_geometry_table<dim>(), parameters.source)
          .make(parameters)
          ->boundary_names();
      }
    } // namespace

    mesh::Idealization
    idealization(const Scene &scene)
    {
      return {choose(mesh::idealization_table(), scene.model).make(),
              scene.thickness};
    }

    std::pair<std::string, std::string>
    split_face(const std::string &face)
    {
      const auto dot = face.find('.');
      if (dot == std::string::npos)
        return {face, ""};
      return {face.substr(0, dot), face.substr(dot + 1)};
    }

    unsigned int
    body_index(const Scene &scene, const std::string &name)
    {
      unsigned int i = 0;
      while (i < scene.bodies.size() && scene.bodies[i].name != name)
        ++i;
      return i;
    }

    std::vector<std::string>
    boundary_names(const Body &body, const unsigned int dimension)
    {
      return dimension == 2 ? boundary_names_in<2>(body.mesh)
                            : boundary_names_in<3>(body.mesh);
    }
  } // namespace scene
} // namespace snug
