#include <snug/base/gather.h>
#include <snug/cad/import_cad.h>
#include <snug/mesh_file/deck_text.h>
#include <snug/mesh_file/import_mesh.h>
#include <snug/scene/cases.h>
#include <snug/scene/check.h>
#include <snug/scene/json_scene.h>
#include <snug/scene/read_scene.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <sstream>

namespace snug::scene {
namespace {
/// Length of a list of choices in the reference above which the list is that of the meanings below
/// the table.
const std::size_t longest_choice = 280;

/// Maximum number of bytes read from devices and pipes.
constexpr std::size_t longest_stream = 16u << 20;

/// Read the contents of a device or a pipe into @p text. If they are too long, store the reason
/// there and return false.
bool try_to_read_stream(std::istream &in, std::string &text)
{
  text.resize(longest_stream + 1);
  in.read(&text[0], static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (text.size() <= longest_stream)
    return true;
  text = "it is not a regular file and holds more than 16 MB";
  return false;
}

/// Read the contents of @p file into @p text. If the file cannot be read, store the reason there
/// and return false.
bool try_to_read(const std::string &file, const TextSource source, std::string &text)
{
  std::error_code unknown;
  const auto      type = std::filesystem::status(file, unknown).type();
  const bool      is_stream =
    type == std::filesystem::file_type::character || type == std::filesystem::file_type::fifo ||
    type == std::filesystem::file_type::block || type == std::filesystem::file_type::socket;
  if (is_stream && source == TextSource::regular_file)
    {
      text = "it must be a regular file, not a device or a pipe";
      return false;
    }
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (is_stream && in)
    return try_to_read_stream(in, text);
  std::ostringstream contents;
  if (in && in.peek() != std::ifstream::traits_type::eof())
    contents << in.rdbuf();
  const bool good = in.is_open() && !in.bad() && errno == 0;
  text            = good ? contents.str() : std::strerror(errno == 0 ? EIO : errno);
  return good;
}

/// Return all statements that take effect, in the order in which they are applied.
std::vector<Statement> statements_of(const SceneSource &source)
{
  auto statements = is_json(source.text) ? parse_json(source.text, source.file)
                                         : parse_statements(source.text, source.file);
  for (const auto &set : source.sets)
    statements.push_back(parse_override(set));
  if (!source.output_directory.empty())
    statements.push_back({"", "Output directory", source.output_directory, {"--output"}});
  // Reject values that printing and reading again would change.
  for (const auto &statement : statements)
    if (statement.value.find_first_of("#\n\r") != std::string::npos ||
        (!statement.value.empty() && statement.value.back() == '\\'))
      throw Origins("", {statement})
        .error(statement.path(), statement.value,
               "must not contain '#' or line ends, nor end with '\\'");
  return with_cases(statements);
}

/// Return the last value of the entry @p path, a list of names.
std::vector<std::string> names_in(const std::vector<Statement> &statements, const std::string &path)
{
  std::string names;
  for (const auto &statement : statements)
    if (statement.path() == path)
      names = statement.value;
  return split(names, ',');
}

/// Make one item for each name in the entry @p path.
template <typename Named>
void make(const std::vector<Statement> &statements,
          const std::string            &path,
          std::vector<Named>           &list)
{
  list.clear();
  for (const auto &name : names_in(statements, path))
    {
      list.emplace_back();
      list.back().name = name;
    }
}

/// Make bodies, load cases, materials, obstacles, points, responses and shapes in a first pass,
/// with names but without contents.
void make_named(const std::vector<Statement> &statements, Scene &scene)
{
  make(statements, "Bodies", scene.bodies);
  make(statements, "Load cases", scene.load_cases);
  make(statements, "Materials", scene.materials);
  make(statements, "Obstacles", scene.obstacles);
  make(statements, "Reference points", scene.points);
  make(statements, "Bolts", scene.bolts);
  make(statements, "Responses", scene.responses);
  make(statements, "Shapes", scene.shapes);
  if (scene.shapes.empty())
    scene.shapes.resize(1);
}

bool belongs_to_pair(const Statement &statement)
{
  return statement.section.rfind("Pair ", 0) == 0;
}

/// Assign the statements outside of subsections. A misspelt list of names is then an unknown entry,
/// rather than names that are missing.
void assign_top(const std::vector<Statement> &statements, Scene &scene)
{
  Entries entries;
  declare(entries, scene);
  for (const auto &statement : statements)
    if (statement.section.empty())
      entries.set(statement);
}

/// Assign all other statements. Pairs inherit the entries of subsection Contact, except entries of
/// their own subsection, independent of the order of the statements.
void assign(const std::vector<Statement> &statements, Scene &scene)
{
  {
    Entries entries;
    declare(entries, scene);
    for (const auto &statement : statements)
      if (!statement.section.empty() && !belongs_to_pair(statement))
        entries.set(statement);
  }
  for (auto &pair : scene.contact.pairs)
    pair.parameters = scene.contact.defaults;
  Entries entries;
  declare(entries, scene);
  for (const auto &statement : statements)
    if (belongs_to_pair(statement))
      entries.set(statement);
}

/// Set members that were left empty to their defaults.
void complete(Scene &scene)
{
  if (!scene.model)
    scene.model = mesh::Idealization::natural(scene.dimension).kind;
  for (auto &body : scene.bodies)
    body.mesh.complete(scene.dimension);
  for (auto &obstacle : scene.obstacles)
    obstacle.complete(scene.dimension);
}

/// Return the ranks that read a scene together.
MPI_Comm communicator(const SceneSource &source)
{
  return source.context == nullptr ? MPI_COMM_SELF : source.context->communicator();
}

/// Return the contents of a mesh file, with the files that it includes. @throws InputError naming
/// the entry.
std::string mesh_text(const SceneSource &source, const std::string &file)
{
  try
    {
      const auto directory = std::filesystem::path(file).parent_path();
      return mesh_file::with_includes(source.read_file(file), [&](const std::string &included) {
        return source.read_file((directory / included).string());
      });
    }
  catch (const InputError &error)
    {
      throw bad_entry("File", file, error.what());
    }
}

/// Read the mesh files and CAD files of all bodies. Their paths become absolute, so that the scene
/// may be printed in another directory.
void read_meshes(const SceneSource &source, const Origins &origins, Scene &scene)
{
  for (auto &body : scene.bodies)
    {
      auto &mesh = body.mesh;
      if (mesh.source != geometry::Source::file && mesh.source != geometry::Source::cad)
        continue;
      for (const auto &[region, material] : body.materials)
        mesh.named_regions.push_back(region);
      const SectionCheck section(body.section(), origins, scene.dimension);
      const bool         is_cad = mesh.source == geometry::Source::cad;
      section.require(!mesh.file.empty() &&
                        (is_cad ? source.context != nullptr : bool(source.read_file)),
                      "File", mesh.file, is_cad ? "must be a CAD file" : "must be a mesh file");
      try
        {
          namespace fs = std::filesystem;
          mesh.file    = fs::absolute(fs::path(source.file).parent_path() / mesh.file)
                        .lexically_normal()
                        .string();
          mesh.imported =
            is_cad ? cad::import_cad(mesh, scene.dimension,
                                     scene.output_directory + "/cad/" + body.name, *source.context)
                   : mesh_file::import_mesh(
                       communicator(source), [&]() { return mesh_text(source, mesh.file); }, mesh,
                       scene.dimension);
        }
      catch (const InputError &error)
        {
          throw section.placed(error, "Mesh", to_text(mesh.source));
        }
    }
}

/// Read the designs of other runs that are the initial ones of shapes.
void read_initial_designs(const SceneSource &source, const Origins &origins, Scene &scene)
{
  for (auto &shape : scene.shapes)
    {
      if (shape.initial_from.empty())
        continue;
      const SectionCheck section(shape.section(), origins, scene.dimension);
      const auto         file = shape.initial_from + "/summary.json";
      try
        {
          section.require(bool(source.read_file), "Initial", shape.initial_from,
                          "cannot be read here");
          const auto summary = nlohmann::json::parse(
            made_on_first_rank(communicator(source), [&]() { return source.read_file(file); }));
          const auto &designs = summary.at("optimization").at("shapes");
          shape.initial       = designs.at(shape.name).get<std::vector<double>>();
        }
      catch (const nlohmann::json::exception &)
        {
          throw section.error("Initial", shape.initial_from,
                              "'" + file + "' has no design of an optimization for this shape");
        }
      catch (const InputError &error)
        {
          throw section.error("Initial", shape.initial_from, error.what());
        }
      shape.initial_from.clear();
    }
}

/// Return whether the mesh of a mesh file or CAD file of the body has elements with triangles.
bool has_triangles(const Body &body)
{
  return body.mesh.imported && body.mesh.imported->has_triangles;
}

std::string table_cell(std::string text)
{
  for (auto bar = text.find('|'); bar != std::string::npos; bar = text.find('|', bar + 2))
    text.insert(bar, "\\");
  return text;
}

/// Print the values of an entry that have meanings as a list, one line each.
void print_meanings(const Entries::Description &entry, std::ostream &out)
{
  if (entry.form.meanings.empty())
    return;
  out << "\n`" << entry.name << "`:\n\n";
  for (const auto &value : entry.form.meanings)
    out << "* `" << value.name << "`: " << value.meaning << "\n";
}
} // namespace

std::string read_text(const std::string &file, const TextSource source)
{
  std::string text;
  if (!try_to_read(file, source, text))
    throw InputError("cannot read the file '" + quotable(file) + "': " + text);
  return text;
}

Scene read_scene(const SceneSource &source)
{
  const auto    statements = statements_of(source);
  const Origins origins(source.file, statements);
  Scene         scene;
  scene.file = source.file;
  make_named(statements, scene);
  assign_top(statements, scene);
  check_names(scene, origins);
  assign(statements, scene);
  complete(scene);
  if (source.context != nullptr)
    source.context->set_verbosity(scene.output.verbosity);
  read_meshes(source, origins, scene);
  read_initial_designs(source, origins, scene);
  if (scene.degree == 0)
    scene.degree = std::any_of(scene.bodies.begin(), scene.bodies.end(), has_triangles) ? 2 : 1;
  // Only rank 0 has the cells of mesh files.
  throw_collectively(communicator(source), [&]() {
    if (source.context == nullptr)
      check(scene, origins);
    else if (source.context->rank() == 0)
      check(scene, origins, source.context->n_ranks());
  });
  return scene;
}

void print(const Scene &scene, std::ostream &out)
{
  Scene   copy = scene;
  Entries entries;
  declare(entries, copy);
  entries.print(out);
}

Entries reference_entries(Scene &scene)
{
  std::vector<Statement> names;
  for (const auto *entry :
       {"Bodies", "Materials", "Obstacles", "Reference points", "Bolts", "Load cases", "Responses"})
    names.push_back({"", entry, "NAME", {}});
  make_named(names, scene);
  scene.contact.pairs.push_back({"SLAVE", "MASTER", {}});
  Entries entries;
  declare(entries, scene);
  return entries;
}

std::string reference_default(const Entries::Description &entry)
{
  return entry.initial == "NAME" || entry.initial == "SLAVE: MASTER" ? "" : entry.initial;
}

void print_reference(std::ostream &out)
{
  Scene      scene;
  const auto entries = reference_entries(scene);
  const auto quoted  = [](const std::string &text) { return text.empty() ? "" : "`" + text + "`"; };
  out << "# Parameters\n\n"
         "`snug --print-parameters` prints this page. Any consistent system of units can be used: "
         "with mm, N and MPa, energies are in N mm.\n";
  for (const auto &section : entries.sections())
    {
      out << "\n## "
          << (section.name.empty() ? "Outside of subsections" : "subsection " + section.name)
          << "\n\n";
      if (!section.meaning.empty())
        out << section.meaning << "\n\n";
      out << "| entry | default | allowed | meaning |\n"
             "|---|---|---|---|\n";
      for (const auto &entry : entries.descriptions())
        if (entry.section == section.name)
          out << "| `" << entry.name << "` | " << quoted(reference_default(entry)) << " | "
              << table_cell(entry.form.allowed.size() > longest_choice ? "a name in the list below"
                                                                       : entry.form.allowed)
              << " | " << table_cell(entry.meaning) << " |\n";
      for (const auto &entry : entries.descriptions())
        if (entry.section == section.name)
          print_meanings(entry, out);
    }
}
} // namespace snug::scene
