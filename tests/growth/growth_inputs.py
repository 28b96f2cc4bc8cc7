"""What the measured commands read that the program does not come with: meshes, scenes, requests, studies, demos."""
import math
import struct

# Written as they are made: what this process holds would count as memory of those that it starts.


def head_of(vertices, faces=0):
    listed = f"element face {faces}\nproperty list uchar int vertex_indices\n" if faces else ""
    return (f"ply\nformat binary_little_endian 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\n"
            f"property float z\n{listed}end_header\n").encode()


def sphere(name, triangles, radius=0.25):
    """A bumpy sphere of about so many triangles, as PLY: rings of quadrangles, each in two."""
    rings = max(4, round(math.sqrt(triangles / 4)))
    around = 2 * rings
    with open(name, "wb") as file:
        file.write(head_of((rings + 1) * around, 2 * (rings - 1) * around))
        for ring in range(rings + 1):
            polar = math.pi * ring / rings
            for step in range(around):
                angle = 2 * math.pi * step / around
                r = radius * (1 + 0.05 * math.sin(7 * angle) * math.sin(polar) ** 2)
                across = r * math.sin(polar)
                file.write(struct.pack("<3f", across * math.cos(angle), across * math.sin(angle), r * math.cos(polar)))
        for ring in range(rings):
            for step in range(around):
                here, beside = ring * around + step, ring * around + (step + 1) % around
                if ring > 0:
                    file.write(struct.pack("<B3i", 3, here, here + around, beside))
                if ring + 1 < rings:
                    file.write(struct.pack("<B3i", 3, beside, here + around, beside + around))


def cloud(name, points, radius=0.25):
    """Points of a sphere, with neither faces nor normals."""
    turn = math.pi * (3 - math.sqrt(5))
    with open(name, "wb") as file:
        file.write(head_of(points))
        for i in range(points):
            z = 1 - (2 * i + 1) / points
            across = radius * math.sqrt(1 - z * z)
            file.write(struct.pack("<3f", across * math.cos(turn * i), across * math.sin(turn * i), radius * z))


def scene(file, views, across=60):
    """One scan of a wavy wall at 0.6 m, and views beside each other that look at it."""
    lines = [f"scan 0 0 0 0 0 0 1 {across * across}"]
    for row in range(across):
        for column in range(across):
            x, y = (0.5 * (column / across - 0.5), 0.5 * (row / across - 0.5))
            lines.append(f"{x:.5f} {y:.5f} {0.6 + 0.02 * math.sin(20 * x):.5f}")
    lines += [f"view {0.3 * (view / views - 0.5):.5f} 0.02 0 0 0 0 1" for view in range(views)]
    file.write_text("\n".join(lines) + "\n")


def requests(file, captures, folder):
    """To a scanner's driver: a capture a line, all from one place."""
    folder.mkdir(exist_ok=True)
    lines = ['{"id": 1, "request": "hello", "protocol": 1}']
    capture = '{{"id": {0}, "request": "capture", "step": {0}, "seed": {0}, "folder": "{1}"}}'
    lines += [capture.format(number + 2, folder) for number in range(captures)]
    file.write_text("\n".join(lines + ['{"id": 0, "request": "bye"}']) + "\n")


def study(file, runs):
    """So many short runs, which differ in their seed."""
    seeds = ", ".join(str(seed) for seed in range(1, runs + 1))
    file.write_text(f"""name = "growth"
[settings]
object.longest_side = 0.5
map.resolution = 0.05
sensor.width = 64
sensor.height = 48
views.count = 12
planner.ray_columns = 8
planner.ray_rows = 6
evaluation.surface_samples = 200
[[planning]]
objects = ["sphere"]
policies = ["random"]
starts = [[30, 20]]
seeds = [{seeds}]
views = 2
""")


def demo(file, seconds):
    """An orbit around a sphere."""
    file.write_text(f"open sphere\norbit {20 * seconds} {seconds}\nwait until done\n")
