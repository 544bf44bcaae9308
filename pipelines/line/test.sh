#!/usr/bin/env bash
# Runs one line with `toile line run` and with Snakemake, and compares every output.
#
#     pipelines/line/test.sh             on this machine
#     pipelines/line/test.sh --slurm     then also on a Slurm of one node
#
# Snakemake comes from PyPI into target/workflow/venv. With --slurm the script installs Debian's packages slurmctld,
# slurmd and munge, writes /etc/slurm/slurm.conf and starts the daemons. So it wants root, on a machine to throw away.
# FABRICS="wool-suiting linen-plain" SIZES="36 38" TRIANGLES=600 say what is sewn. TOILE is the program. VARIANTS=34 sews
# each of STYLES="long-skirt t-shirt fitted-bodice" with so many meshes, and writes no reports. QUICK=40 prints the skirt
# from 40 copies of its pattern and drapes nothing, so the engines alone are seen; CHUNK=10 makes chunks.
set -euo pipefail
cd "$(dirname "$0")/../.."
here=$PWD/pipelines/line
work=$PWD/${CARGO_TARGET_DIR:-target}/workflow
toile=${TOILE:-${CARGO_TARGET_DIR:-target}/release/toile}
toile=$(realpath "$toile")
fabrics=(${FABRICS:-wool-suiting linen-plain})
quick=${QUICK:-0}
sizes=(${SIZES:-36 38 40})
variants=${VARIANTS:-0}
styles=(${STYLES:-long-skirt})

fail() { echo "FAILED: $*" >&2; exit 1; }
# timed NAME COMMAND…: runs it, tells its wall time, and keeps its exit code in `code`.
timed() {
    local name=$1 began
    shift
    began=$(date +%s.%N)
    code=0
    ("$@") >"$work/$name.log" 2>&1 || code=$?
    echo "$name: $(echo "$(date +%s.%N) - $began" | bc) s, exit code $code"
}
# snake PROFILE OUT MORE…: becomes Snakemake, so it wants a shell of its own.
snake() {
    local profile=$1 out=$2
    shift 2
    cd "$work"
    exec "$work/venv/bin/snakemake" --snakefile "$here/Snakefile" --profile "$here/profiles/$profile" \
        --config line=project/lines/line.toml out="$out" toile="$toile" ${CHUNK:+chunk=$CHUNK} "$@"
}
line() { "$toile" line "$1" "$work/project/lines/line.toml" --out "$work/$2" "${@:3}"; }
# What the jobs wrote; times stand in the records alone.
hashes() {
    (cd "$work/$1/jobs" && find . -type f ! -name run.json ! -name '.*' -print0 | sort -z | xargs -0 sha256sum)
}
same() {
    diff <(hashes "$1") <(hashes "$2") >"$work/differ.txt" || fail "$1 and $2 differ: $work/differ.txt"
    echo "same bytes: $(hashes "$1" | wc -l) files of $1 and $2"
}
# Jobs whose record is new since the file `mark`.
ran() { find "$work/$1/jobs" -name run.json -newer "$work/mark" | wc -l; }
mark() { sleep 0.1; touch "$work/mark"; sleep 0.1; }
count() { [ "$2" = "$3" ] || fail "$1: $2 jobs ran, not $3"; echo "$1: $2 jobs ran"; }

install() {
    mkdir -p "$work"
    [ -d "$work/venv" ] || python3 -m venv "$work/venv"
    "$work/venv/bin/pip" install -q --disable-pip-version-check -r "$here/requirements.txt"
}

# A project of its own, since a fabric in it is changed.
project() {
    rm -rf "$work"/{project,serial,pair,local,broken,both,slurm}
    mkdir -p "$work/project"/{lines,pipelines,samples/patterns}
    touch "$work/project/toile.root"
    local style
    for style in "${styles[@]}"; do
        cp -r "pipelines/$style" "$work/project/pipelines/"
        cp "samples/patterns/$style".* "$work/project/samples/patterns/"
    done
    cp -r samples/{bodies,fabrics,textures} "$work/project/samples/"
    list() { printf '"%s", ' "$@"; }
    jobs=$((${#sizes[@]} * ${#fabrics[@]}))
    if [ "$quick" != 0 ]; then prints; elif [ "$variants" != 0 ]; then drapes; else skirts; fi
    changes=$((jobs / ${#fabrics[@]}))
}

# A chain that drapes nothing; copies of the pattern stand for the fabrics.
prints() {
    local k
    fabrics=()
    for k in $(seq "$quick"); do
        fabrics+=("pattern-$k")
        cp samples/patterns/long-skirt.astm.dxf "$work/project/samples/patterns/pattern-$k.dxf"
    done
    jobs=$((${#sizes[@]} * quick))
    cat >"$work/project/pipelines/prints.toml" <<END
toile = 1
[pipeline]
line = "prints"
version = 1
[input]
size = { kind = "text", default = "38" }
fabric = { kind = "text", default = "pattern-1" }
[[stage]]
use = "import-dxf"
with.file = "../samples/patterns/{fabric}.dxf"
with.sewing = "../samples/patterns/long-skirt.sewing.toml"
with.size = "{size}"
[[stage]]
use = "export-print"
with.file = "{out}/pieces.svg"
END
    cat >"$work/project/lines/line.toml" <<END
toile = 1
[line]
name = "prints"
[[style]]
name = "skirt"
pipeline = "../pipelines/prints.toml"
[matrix]
size = [$(list "${sizes[@]}")]
fabric = [$(list "${fabrics[@]}")]
END
}

skirts() {
    cat >"$work/project/lines/line.toml" <<END
toile = 1
[line]
name = "small"
[[style]]
name = "skirt"
pipeline = "../pipelines/long-skirt/v1.toml"
set = { triangulate.triangles = ${TRIANGLES:-600} }
[matrix]
size = [$(list "${sizes[@]}")]
fabric = [$(list "${fabrics[@]}")]
END
}

# Each style with so many meshes.
drapes() {
    local style k set line=$work/project/lines/line.toml
    printf 'toile = 1\n[line]\nname = "drapes"\n' >"$line"
    printf '[matrix]\nsize = [%s]\nfabric = [%s]\n' "$(list "${sizes[@]}")" "$(list "${fabrics[@]}")" >>"$line"
    for style in "${styles[@]}"; do
        sed -i '/^\[\[stage\]\]$/{N;/export-report/d}' "$work/project/pipelines/$style/v1.toml"
        printf '[[style]]\nname = "%s"\npipeline = "../pipelines/%s/v1.toml"\n[style.matrix.mesh]\n' "$style" "$style" >>"$line"
        for k in $(seq "$variants"); do
            set="edge_length = \"$((240 + 2 * k))e-1 mm\""
            [ "$style" != long-skirt ] || set="triangles = $((600 + 20 * k))"
            printf 'm%s = { triangulate.%s }\n' "$k" "$set" >>"$line"
        done
    done
    jobs=$((jobs * variants * ${#styles[@]}))
}

on_this_machine() {
    local fabric=$work/project/samples/fabrics/${fabrics[0]}.toml
    [ "$quick" = 0 ] || fabric=$work/project/samples/patterns/${fabrics[0]}.dxf
    timed serial line run serial -j 1 --threads 1 --quiet
    local serial=$code
    killed pair exec "$toile" line run "$work/project/lines/line.toml" --out "$work/pair" -j 2 --quiet
    same serial pair
    timed local snake local local
    [ "$code" = "$serial" ] || fail "line run ended with $serial, Snakemake with $code"
    same serial local
    mark
    timed nothing-to-do snake local local
    count "nothing changed" "$(ran local)" 0

    cp "$fabric" "$work/fabric"
    sed -i 's/^areal_mass .*/areal_mass = "231 g\/m2"/' "$fabric"
    # A pattern gets a comment, which is another content.
    [ "$quick" = 0 ] || { printf '999\nchanged\n' && cat "$work/fabric"; } >"$fabric"
    cmp -s "$fabric" "$work/fabric" && fail "the fabric has no areal_mass"
    mark
    timed one-fabric snake local local
    count "one fabric changed" "$(ran local)" $changes
    # The other engine goes on in the same folder: it finds all of it done, and does what is changed back.
    mark
    line run local --quiet >/dev/null || [ $? = "$serial" ]
    count "line run after Snakemake" "$(ran local)" 0
    cp "$work/fabric" "$fabric"
    mark
    line run local --quiet >/dev/null || [ $? = "$serial" ]
    count "line run, fabric as before" "$(ran local)" $changes
    mark
    timed after-line-run snake local local
    count "Snakemake after line run" "$(ran local)" 0
    same serial local

    killed broken snake local broken
    same serial broken
    # A print that can fail is refused by `line jobs`, and with many meshes there are no reports.
    [ "$quick$variants" != 00 ] || failures
}

# killed FOLDER COMMAND…: killed at random moments after shares of its jobs are done, and resumed. The command has to
# become one process.
killed() {
    local folder=$1 k pid
    shift
    records() { find "$work/$folder/jobs" -name run.json 2>/dev/null | wc -l; }
    for k in 1 2 3; do
        "$@" >"$work/killed-$folder-$k.log" 2>&1 &
        pid=$!
        while kill -0 "$pid" 2>/dev/null && [ "$(records)" -lt $((2 * k - 1 + (k - 1) * jobs / 4)) ]; do sleep 0.05; done
        sleep 0.$((RANDOM % 10))
        kill -KILL "$pid" 2>/dev/null || true
        wait "$pid" 2>/dev/null || true
        echo "$folder killed; $(records) records"
    done
    timed "$folder-resumed" "$@"
}

# A job that cannot run: its exit code is found, its record and its page stay, and the others run.
failures() {
    cp "$work/project/lines/line.toml" "$work/line.toml"
    cat >>"$work/project/lines/line.toml" <<END
[[include]]
style = "skirt"
size = "${sizes[0]}"
fabric = "${fabrics[0]}"
name = "tight"
set = { drape.limits.strain_max = 0.000001 }
END
    timed failing snake local local
    [ "$code" != 0 ] || fail "Snakemake ended well"
    local folder
    folder=$(echo "$work"/local/jobs/*_tight)
    grep -q '"exit_code": 1' "$folder/run.json" || fail "no record of the failure"
    [ -s "$folder/report.html" ] || [ -s "$folder/failure.html" ] || fail "no page of the failure"
    code=0
    line report local >/dev/null || code=$?
    echo "line report: exit code $code, page $(ls "$folder" | grep html | xargs)"
    [ "$code" = 1 ] || fail "line report ended with $code"
    mark
    timed failing-again snake local local
    count "a lasting failure, again" "$(ran local)" 0
    cp "$work/line.toml" "$work/project/lines/line.toml"
    rm -r "$folder"
}

# A Slurm of one node: controller, node and munge, started by hand.
slurm_up() {
    local conf=/etc/slurm/slurm.conf made="# Made by pipelines/line/test.sh"
    apt-get install -q -y --no-install-recommends slurmctld slurmd slurm-client munge >"$work/apt.log" 2>&1
    [ ! -f $conf ] || head -1 $conf | grep -qx "$made" || fail "there is a Slurm on this machine: $conf"
    mkdir -p /etc/slurm "$work"/slurmd /run/munge /var/log/munge "$work/state"
    cat >$conf <<END
$made
ClusterName=one
SlurmctldHost=$(hostname)
SlurmUser=root
AuthType=auth/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
ReturnToService=2
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/slurmd
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
MaxArraySize=10001
MaxJobCount=20000
SchedulerParameters=sched_interval=5,batch_sched_delay=1
$(slurmd -C | head -1)
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
END
    chown munge: /run/munge /var/log/munge
    [ -S /run/munge/munge.socket.2 ] || runuser -u munge -- munged
    scontrol ping 2>/dev/null | grep -q UP || slurmctld
    sleep 1
    [ -f "$work/slurmd.pid" ] && kill -0 "$(cat "$work/slurmd.pid")" 2>/dev/null || slurmd
    for _ in $(seq 60); do
        sinfo -h -o %T 2>/dev/null | grep -q idle && break
        sleep 1
    done
    sinfo
}
slurm_down() { for name in slurmd slurmctld; do kill "$(cat "$work/$name.pid")"; done; }

on_slurm() {
    slurm_up
    timed slurm snake slurm slurm
    slurm_down
    same serial slurm
}

install
project
on_this_machine
if [ "${1:-}" = --slurm ]; then on_slurm; fi
echo "all is well"
