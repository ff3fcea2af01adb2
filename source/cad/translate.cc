#include <snug/base/errors.h>
#include <snug/base/values.h>
#include <snug/cad/faces.h>
#include <snug/cad/near_faces.h>
#include <snug/cad/size_field.h>
#include <snug/cad/translate.h>

#include <Standard_Failure.hxx>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <sstream>

namespace snug::cad {
namespace {
/// Return a number with few digits; numbers of the size of rounding are 0.
std::string rounded(const double x, const double size, const unsigned int digits = 4)
{
  std::ostringstream text;
  text.precision(digits);
  text << (std::abs(x) < 1e-7 * size ? 0. : x);
  return text.str();
}

/// This class writes the parameter file of the solids of a CAD file.
class AssemblyWriter
{
public:
  AssemblyWriter(const std::string &path)
    : file(std::filesystem::path(path).filename().string()), parts(read_solids(path))
  {
    for (const auto &part : parts)
      {
        faces.push_back(describe_faces(part));
        boundaries.push_back(boundaries_of(faces.back(), {}));
        for (const auto &face : faces.back())
          for (unsigned int d = 0; d < 3; ++d)
            {
              lower[d] = std::min(lower[d], face.lower[d]);
              upper[d] = std::max(upper[d], face.upper[d]);
            }
        names.push_back(unused_name(part));
      }
  }

  std::string text()
  {
    out << "# Bodies of " << file
        << " by 'snug --translate'. This file belongs into the directory of " << file
        << ".\n# Units: mm, N, MPa. Supports and loads are to be added to the bodies.\n\n"
        << "set Dimension = 3\nset Bodies = " << to_text(names)
        << "\nset Materials = steel\nset Units = mm, N\n\n"
        << "# Placeholder values of steel, because CAD files contain no material.\n"
        << "subsection Material steel\n  set Young's modulus = 210000\n  set Poisson's ratio = "
           "0.3\nend\n";
    for (unsigned int b = 0; b < parts.size(); ++b)
      write_body(b);
    write_contacts();
    write_symmetries();
    return out.str();
  }

private:
  std::string                           file;
  std::vector<Part>                     parts;
  std::vector<std::vector<FaceInfo>>    faces;
  std::vector<std::vector<std::string>> boundaries;
  std::vector<std::string>              names;
  dealii::Point<3>                      lower{HUGE_VAL, HUGE_VAL, HUGE_VAL};
  dealii::Point<3>                      upper{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  std::ostringstream                    out;

  /// Return the name of a body: the name of the solid, made of the characters of names.
  std::string unused_name(const Part &part) const
  {
    std::string name = part.name;
    for (char &c : name)
      if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_')
        c = '-';
    if (name.empty())
      name = "solid-" + std::to_string(names.size() + 1);
    std::string result = name;
    for (unsigned int k = 2; std::count(names.begin(), names.end(), result) > 0; ++k)
      result = name + "-" + std::to_string(k);
    return result;
  }

  std::string boundary(const unsigned int body, const unsigned int face) const
  {
    return names[body] + "." + boundaries[body][face];
  }

  void write_body(const unsigned int b)
  {
    out << "\nsubsection Body " << names[b] << "\n  # Box:";
    for (unsigned int d = 0; d < 3; ++d)
      {
        double from = HUGE_VAL, to = -HUGE_VAL;
        for (const auto &face : faces[b])
          {
            from = std::min(from, face.lower[d]);
            to   = std::max(to, face.upper[d]);
          }
        out << (d == 0 ? " " : ", ") << "xyz"[d] << ' ' << rounded(from, parts[b].size) << " to "
            << rounded(to, parts[b].size);
      }
    out << "\n  set Mesh = cad\n  set File = " << file;
    if (parts.size() > 1)
      out << "\n  set Solid = " << b + 1;
    out << "\n  set Element size = " << rounded(suggested_size(parts[b]), 0., 2)
        << "\n  set Materials = steel\nend\n";
  }

  /// Return the near faces of each two bodies in groups that are connected by common boundaries.
  static std::vector<std::vector<NearFaces>> connected(const std::vector<NearFaces> &all)
  {
    std::vector<std::vector<NearFaces>> result;
    for (const auto &pair : all)
      {
        std::vector<NearFaces> own       = {pair};
        const auto             is_beside = [&](const NearFaces &other) {
          return other.parts == pair.parts &&
                 (other.faces[0] == pair.faces[0] || other.faces[1] == pair.faces[1]);
        };
        for (auto group = result.begin(); group != result.end();)
          if (std::any_of(group->begin(), group->end(), is_beside))
            {
              own.insert(own.begin(), group->begin(), group->end());
              group = result.erase(group);
            }
          else
            ++group;
        result.push_back(own);
      }
    return result;
  }

  /// Return a side of a contact pair, "pin.face-1 + pin.face-2".
  std::string side(const std::vector<NearFaces> &group, const unsigned int s) const
  {
    std::set<unsigned int> own;
    for (const auto &pair : group)
      own.insert(pair.faces[s]);
    std::string           result;
    std::set<std::string> used; // several faces may have one name
    for (const unsigned int f : own)
      if (used.insert(boundaries[group[0].parts[s]][f]).second)
        result += (result.empty() ? "" : " + ") + boundary(group[0].parts[s], f);
    return result;
  }

  void write_contacts()
  {
    const auto groups = connected(near_faces(parts));
    if (groups.empty())
      return;
    out << "\n# Faces with a distance of at most 1 % of the diagonal of the smaller solid:\n";
    std::string pairs, entries;
    for (const auto &group : groups)
      {
        double gap = HUGE_VAL;
        for (const auto &pair : group)
          {
            write_near(pair);
            gap = std::min(gap, pair.gap);
          }
        const std::string both = side(group, 0) + ": " + side(group, 1);
        pairs += (pairs.empty() ? "" : ", ") + both;
        if (gap < -1e-7 * parts[group[0].parts[0]].size)
          entries += "\n# The solids overlap by " + rounded(-gap, 0.) + ".\nsubsection Pair " +
                     both + "\n  set Interference = true\nend\n";
      }
    out << "subsection Contact\n  set Pairs = " << pairs << "\nend\n" << entries;
  }

  void write_near(const NearFaces &pair)
  {
    double smaller = HUGE_VAL;
    out << "# ";
    for (const unsigned int s : {0u, 1u})
      {
        const auto &face = faces[pair.parts[s]][pair.faces[s]];
        smaller          = std::min(smaller, face.area);
        out << (s == 0 ? "" : " and ") << boundary(pair.parts[s], pair.faces[s]) << " ("
            << face.kind << ", area " << rounded(face.area, 0.) << ")";
      }
    out << ": gap " << rounded(pair.gap, parts[pair.parts[0]].size) << ", near over the area "
        << rounded(pair.area, 0.);
    if (pair.area < 0.2 * smaller)
      out << ", a small contact, which needs small elements by 'Face sizes'";
    out << '\n';
  }

  /// Write the sides of the box of all solids on which several solids have plane faces.
  void write_symmetries()
  {
    const double size = lower.distance(upper);
    for (unsigned int d = 0; d < 3; ++d)
      for (const double at : {lower[d], upper[d]})
        {
          std::set<unsigned int> own;
          std::string            supports;
          for (unsigned int b = 0; b < parts.size(); ++b)
            for (unsigned int f = 0; f < faces[b].size(); ++f)
              if (faces[b][f].kind == "plane" &&
                  std::abs(faces[b][f].lower[d] - at) < 1e-7 * size &&
                  std::abs(faces[b][f].upper[d] - at) < 1e-7 * size)
                {
                  own.insert(b);
                  supports += "\n#   Body " + names[b] + ": set Supports = " + boundaries[b][f] +
                              ": " + "xyz"[d];
                }
          if (own.size() > 1)
            out << "\n# Possible symmetry plane " << "xyz"[d] << " = " << rounded(at, size) << ':'
                << supports << '\n';
        }
  }
};
} // namespace

std::string translate(const std::string &path)
{
  try
    {
      return AssemblyWriter(path).text();
    }
  catch (const InputError &error)
    {
      throw InputError(path + ": " + error.what());
    }
  catch (const Standard_Failure &failure)
    {
      throw InputError(path + ": OpenCASCADE fails: " + failure.GetMessageString());
    }
}
} // namespace snug::cad
